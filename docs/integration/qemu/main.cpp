// A robot on an emulated chip in an empty world; its wheels follow every command at once.
#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/robot.hpp"
#include "hal/board.hpp"

using namespace whisker;

struct EmptyWorld final : hal::Rangefinders {
  bool read(hal::RangeReadings& out) noexcept override {
    const uint8_t sequence = static_cast<uint8_t>(++measured & 15U);
    for (hal::RangeReading& beam : out.beam) beam = {0, hal::RangeStatus::clear, 0, sequence};
    return true;
  }
  uint32_t measured = 0;
};

struct PerfectWheels final : hal::Drive {
  bool command(hal::WheelSpeeds speeds) noexcept override {
    left += speeds.left;  // 0.1 mm/s for 10 ms: 1 um
    right += speeds.right;
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    out = {counts(left), counts(right)};
    return true;
  }
  static uint32_t counts(int32_t um) noexcept {
    return static_cast<uint32_t>(um / 200) % hal::kEncoderModulus;  // 5,000 counts a metre
  }
  int32_t left = 0;
  int32_t right = 0;
};

int main() {
  static constexpr Params params;
  static EmptyWorld sensors;
  static PerfectWheels wheels;
  static planning::TableBoundaryPlanner boundary{params, fuzzy::kDefaultTable};
  static Robot robot{sensors, wheels, boundary.planner, params};
  hal::Console& console = hal::board().console;

  robot.place({});
  robot.set_goal({{1_m, 500_mm}, 50_mm});
  const char* said = "";
  for (uint32_t now = 0; now < 60000; now += 10) {
    const Status& status = robot.tick(Time::from_raw(now));
    const char* why = planning::name(status.decision.why);
    if (why != said) {
      console.print(planning::name(status.decision.mode));
      console.print(": ");
      console.print(why);
      console.print("\n");
      said = why;
    }
    if (status.decision.outcome == planning::Outcome::reached) return 0;
  }
  return 1;
}
