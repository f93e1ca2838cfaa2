// The reference robot on an STM32F405: drives 2 m ahead and stops. It uses the calibration that its flash
// has.
#include "firmware/calibration/store.hpp"
#include "firmware/planning/default_planner.hpp"
#include "hal/boards/stm32f405/flash_storage.hpp"
#include "hal/boards/stm32f405/robot_board.hpp"
#include "hal/boards/stm32f405/robot_params.hpp"
#include "hal/boards/stm32f405/vl53l0x.hpp"

namespace {

whisker::Params calibrated() noexcept {
  using namespace whisker;
  Params params = hal::stm32f405::kRobotParams;
  hal::stm32f405::FlashStorage storage;
  calibration::apply_stored(storage, params);
  return params;
}

}  // namespace

int main() {
  using namespace whisker;
  using namespace whisker::hal::stm32f405;
  static_assert(kRobotParams.gyro.fitted == Fitted::no || mpu6050::setup_of(kRobotParams.gyro).possible);
  static const Params params = calibrated();
  static RobotBoard board(kVl53l0x, kMotorParams, kMotorParams, kRobotParams.gyro);
  static planning::DefaultPlanner planner(params, fuzzy::kDefaultTable);
  static Robot robot(board.rangefinders(), board.drive(), planner.planner, params, &board.bumper(),
                     &board.gyro());

  board.start();
  robot.place({});
  robot.set_goal({{2_m, 0_m}, 100_mm});
  for (;;) {
    board.poll(robot.status());
    if (board.due(static_cast<uint32_t>(params.safety.period.raw()))) robot.tick(board.now());
  }
}
