// The smallest firmware: the core with one planner, and drivers without function. scripts/budget measures its
// size.
#include "firmware/apps/planner.hpp"
#include "firmware/apps/static_storage.hpp"
#include "firmware/robot.hpp"
#include "hal/board.hpp"

using namespace whisker;

namespace {

struct NoSensors final : hal::Rangefinders {
  bool read(hal::RangeReadings&) noexcept override { return false; }
};
struct NoWheels final : hal::Drive {
  bool command(hal::WheelSpeeds) noexcept override { return true; }
  bool read(hal::EncoderCounts&) noexcept override { return false; }
};

constexpr Params kParams;
NoSensors sensors;
NoWheels wheels;
StaticStorage<sizeof(images::Planner)> room_for_planner;
StaticStorage<sizeof(Robot)> room_for_robot;

}  // namespace

int main() {
  hal::Clock& clock = hal::board().clock;
  planning::Planner& planner = room_for_planner.make<images::Planner>(kParams, fuzzy::kDefaultTable).planner;
  auto& robot = room_for_robot.make<Robot>(sensors, wheels, planner, kParams);
  robot.place({});
  robot.set_goal({{4_m, 1_m}, 100_mm});
  for (int i = 0; i < 10; ++i) robot.tick(Time::from_raw(clock.now_ms()));
  return robot.status().health.fault == Fault::none ? 1 : 0;
}
