/// The robot on the simulated plant; the test controls the ticks and the faults of the board.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "firmware/planning/planner.hpp"
#include "firmware/robot.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/recording_planner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::test {

/// Wraps a board; each hook, if set, can change the values that pass.
class FaultyBoard final : public hal::Rangefinders, public hal::Drive {
 public:
  explicit FaultyBoard(sim::Plant& plant) : board_(plant) {}
  bool read(hal::RangeReadings& out) noexcept override;
  bool read(hal::EncoderCounts& out) noexcept override;
  bool command(hal::WheelSpeeds speeds) noexcept override;

  std::function<void(hal::RangeReadings&)> ranges;
  std::function<void(hal::EncoderCounts&)> counts;
  std::function<bool(hal::WheelSpeeds&)> wheels;  ///< false: refused

 private:
  hal::SimBoard board_;
};

class Bench {
 public:
  using MakePlanner = std::function<std::shared_ptr<planning::Planner>(const Params&)>;
  Bench(const Scenario& scenario, const MakePlanner& planner);
  Bench(const Scenario& scenario, PlannerKind planner)
      : Bench(scenario, [planner](const Params& params) { return make_planner(planner, params); }) {}
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// One tick. False: the run has ended, by contact, fault or verdict.
  bool tick();
  /// The time until the next tick.
  void pass(int gap_ms);
  bool step(int gap_ms) {
    const bool on = tick();
    pass(gap_ms);
    return on && !plant_.in_contact();
  }
  /// Ticks until the run ends or the simulated time has passed.
  void run(double seconds, const std::function<int()>& gap_ms);
  void run(double seconds);  ///< with steady periods

  const Status& status() const { return robot_.status(); }
  /// The result: "reached", "contact", a fault's name, "running" ...
  std::string ended() const;
  Robot& robot() { return robot_; }
  FaultyBoard& board() { return board_; }
  sim::Plant& plant() { return plant_; }
  const sim::WorldView& world() const { return world_.view(); }
  const perception::LocalGrid* local_grid() const { return seen_.local_grid(); }
  std::uint32_t now_ms() const { return now_ms_; }
  /// Disturbs the clock.
  void set_clock(std::uint32_t ms) { now_ms_ = ms; }

 private:
  static sim::RobotSpec fine(const Params& params);

  const Scenario scenario_;
  SimWorld world_;
  sim::Plant plant_;
  FaultyBoard board_;
  std::shared_ptr<planning::Planner> planner_;
  RecordingPlanner seen_;
  Robot robot_;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::test
