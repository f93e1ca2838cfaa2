#include "tests/missions/bench.hpp"

#include "host/harness/run/pilot.hpp"
#include "host/harness/run/spec.hpp"

namespace whisker::test {

bool FaultyBoard::read(hal::RangeReadings& out) noexcept {
  if (!board_.read(out)) return false;
  if (ranges) ranges(out);
  return true;
}

bool FaultyBoard::read(hal::EncoderCounts& out) noexcept {
  if (!board_.read(out)) return false;
  if (counts) counts(out);
  return true;
}

bool FaultyBoard::command(hal::WheelSpeeds speeds) noexcept {
  const bool taken = !wheels || wheels(speeds);
  return board_.command(taken ? speeds : hal::WheelSpeeds{}) && taken;
}

sim::RobotSpec Bench::fine(const Params& params) {
  sim::RobotSpec spec = sim::robot_spec(params);
  spec.period_s = 0.001;
  return spec;
}

Bench::Bench(const Scenario& scenario, const MakePlanner& planner)
    : scenario_(scenario),
      world_(scenario_),
      plant_(world_.view(), fine(scenario_.robot), noise_spec(scenario_.noise), scenario_.seed,
             scenario_.start),
      board_(plant_),
      planner_(planner(scenario_.robot)),
      seen_(*planner_),
      robot_(board_, board_, seen_, scenario_.robot) {
  robot_.place(fixed_pose(scenario_.start));
  robot_.set_goal(fixed_goal(scenario_.goal));
}

bool Bench::tick() {
  const Status& status = robot_.tick(Time::from_raw(now_ms_));
  return !plant_.in_contact() && status.health.fault == Fault::none &&
         status.decision.outcome == planning::Outcome::running;
}

void Bench::pass(int gap_ms) {
  now_ms_ += static_cast<std::uint32_t>(gap_ms);
  for (int ms = 0; ms < gap_ms && !plant_.in_contact(); ++ms) plant_.advance();
}

void Bench::run(double seconds, const std::function<int()>& gap_ms) {
  const double until = plant_.time() + seconds;
  while (plant_.time() < until && step(gap_ms())) {
  }
}

void Bench::run(double seconds) {
  run(seconds, [this] { return static_cast<int>(scenario_.robot.safety.period.raw()); });
}

std::string Bench::ended() const {
  if (plant_.in_contact()) return "contact";
  if (robot_.status().health.fault != Fault::none) return name(robot_.status().health.fault);
  switch (robot_.status().decision.outcome) {
    case planning::Outcome::none: return "none";
    case planning::Outcome::running: return "running";
    case planning::Outcome::reached: return "reached";
    case planning::Outcome::unreachable: return "unreachable";
    case planning::Outcome::gave_up: return "gave_up";
  }
  return "?";
}

}  // namespace whisker::test
