/// The guard on the simulated plant; the test commands.
#pragma once

#include <cmath>
#include <cstdint>

#include "firmware/guard.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::test {

/// Makes the readings of the sensors stale, or refuses commands.
class GuardBoard final : public hal::Rangefinders, public hal::Drive {
 public:
  explicit GuardBoard(sim::Plant& plant) : board_(plant) {}
  bool read(hal::RangeReadings& out) noexcept override {
    if (!blind) return board_.read(out);
    return false;
  }
  bool read(hal::EncoderCounts& out) noexcept override { return board_.read(out); }
  bool command(hal::WheelSpeeds speeds) noexcept override { return board_.command(speeds) && !refuses; }

  bool blind = false;
  bool refuses = false;

 private:
  hal::SimBoard board_;
};

struct GuardBench {
  explicit GuardBench(const Scenario& s)
      : scenario(s),
        world(scenario),
        plant(world.view(), robot_spec(scenario), noise_spec(scenario.noise), scenario.seed, scenario.start),
        board(plant),
        guard(board, board, scenario.robot) {}
  GuardBench(const GuardBench&) = delete;
  GuardBench& operator=(const GuardBench&) = delete;

  Time now() const { return Time::from_raw(now_ms); }
  double speed() const { return (plant.v_left() + plant.v_right()) / 2; }
  const GuardStatus& step() {
    guard.tick(now());
    plant.advance();
    now_ms += static_cast<std::uint32_t>(scenario.robot.safety.period.raw());
    return guard.status();
  }
  /// Commands in every tick.
  const GuardStatus& drive(const Velocity& velocity, double seconds) {
    for (const double until = plant.time() + seconds; plant.time() < until;) {
      guard.command(velocity, now());
      step();
    }
    return guard.status();
  }

  const Scenario scenario;
  SimWorld world;
  sim::Plant plant;
  GuardBoard board;
  Guard guard;
  std::uint32_t now_ms = 0;
};

}  // namespace whisker::test
