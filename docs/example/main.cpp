// A complete firmware around the core: three drivers, the parameters of the robot, and a loop.
#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/robot.hpp"
#include "hal/clock.hpp"

using namespace whisker;

// You implement these: three classes over your own drivers (the headers in hal/ state the requirements), a
// function that prints a line, and a lamp.
struct Sonar final : hal::Rangefinders {
  bool read(hal::RangeReadings& out) noexcept override;
};
struct Motors final : hal::Drive {
  bool command(hal::WheelSpeeds speeds) noexcept override;
  bool read(hal::EncoderCounts& out) noexcept override;
};
struct Timer final : hal::Clock {
  uint32_t now_ms() noexcept override;
};
void print(const char* words);
void set_lamp(bool on);

// Set the parameters that differ from the reference robot. check() tests whether they fit together.
constexpr Params my_robot() {
  Params p;
  p.body.radius = 75_mm;
  p.body.track = 110_mm;
  p.wheels.max_speed = 250_mm_per_s;
  p.wheels.counts_per_metre = 3200;
  return p;
}
static_assert(check(my_robot()) == ParamFault::none, "the parameters do not fit: ask `whisker robot check`");

int main() {
  static constexpr Params params = my_robot();
  static Sonar sonar;
  static Motors motors;
  static Timer timer;
  static planning::TableBoundaryPlanner skirt{params, fuzzy::kDefaultTable};
  static Robot robot{sonar, motors, skirt.planner, params};

  robot.place({{0_m, 0_m}, 0_deg});
  robot.set_goal({{4_m, 1_m}, 100_mm});
  Fault told = Fault::none;
  for (uint32_t next = timer.now_ms();; next += 10) {
    while (static_cast<int32_t>(timer.now_ms() - next) < 0) {
    }
    const Status& status = robot.tick(Time::from_raw(next));
    const Fault fault = status.health.fault;
    if (fault != Fault::none) {
      // The core stops the wheels until robot.reset(). Report the fault and call an operator.
      if (fault != told) print(fault == Fault::invalid_params ? name(check(params)) : name(fault));
      set_lamp(next / 500 % 2 == 0);
    }
    told = fault;
    if (status.decision.outcome == planning::Outcome::reached) robot.cancel();
  }
}
