/// A simulated robot behind a base node, on a bus in memory, in simulated time.
#pragma once

#include <utility>

#include "firmware/apps/can/base.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::test {

inline Scenario open_ground() {
  return parse_scenario("name = \"open\"\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 30.0\ny_m = 0.0\n",
                        "open.toml");
}

inline void repair(hal::CanFrame& frame) {
  if (frame.size > 0) frame.data[0] = can::crc_of(frame.id, frame.data, frame.size);
}

class BaseSide {
 public:
  BaseSide(const Scenario& scenario, bus::Schedule faults, std::uint64_t seed)
      : scenario_(scenario),
        world_(scenario_),
        plant_(world_.view(), robot_spec(scenario_), noise_spec(scenario_.noise), scenario_.seed,
               scenario_.start),
        board_(plant_),
        port_(wire_.attach(), std::move(faults), seed, repair),
        node_(port_, {1, 11, 0}, 100),
        base_(node_, board_, board_) {}

  void give(can::Order order) {
    node_.give(order, {fixed_pose(scenario_.start), fixed_goal(scenario_.goal)}, can::SyncMode::real_time);
  }
  /// One control period. others: the other nodes, polled every millisecond. Returns the speeds of the wheels.
  template <class Others>
  hal::WheelSpeeds tick(const Others& others) {
    port_.at_tick(tick_);
    base_.measure(tick_, 10);
    base_.publish(can::SyncMode::real_time);
    for (int ms = 0; ms < 10; ++ms) {
      ++now_ms_;
      node_.poll(now_ms_);
      others(now_ms_);
    }
    node_.poll(now_ms_);
    const hal::WheelSpeeds speeds = base_.drive();
    plant_.advance();
    ++tick_;
    return speeds;
  }

  std::uint32_t ticks() const { return tick_; }
  can::BaseNode& node() { return node_; }
  const sim::Plant& plant() const { return plant_; }
  bus::FaultPort& port() { return port_; }
  bus::MemoryBus& wire() { return wire_; }

 private:
  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  hal::SimBoard board_;
  bus::MemoryBus wire_;
  bus::FaultPort port_;
  can::BaseNode node_;
  can_app::Base base_;
  std::uint32_t tick_ = 0;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::test
