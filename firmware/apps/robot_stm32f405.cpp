// The reference robot on an STM32F405: drives 2 m ahead and stops. It uses the calibration that its flash
// has, and its button starts a new one.
#include "firmware/apps/calibration/self_calibration.hpp"
#include "firmware/planning/default_planner.hpp"
#include "hal/boards/stm32f405/robot_board.hpp"
#include "hal/boards/stm32f405/robot_params.hpp"
#include "hal/boards/stm32f405/vl53l0x.hpp"

namespace {

whisker::Params calibrated(const whisker::planning::Calibrator& calibrator) noexcept {
  whisker::Params params = whisker::hal::stm32f405::kRobotParams;
  calibrator.apply(params);
  return params;
}

}  // namespace

int main() {
  using namespace whisker;
  using namespace whisker::hal::stm32f405;
  static_assert(kRobotParams.gyro.fitted == Fitted::no || mpu6050::setup_of(kRobotParams.gyro).possible);
  static RobotBoard board(kVl53l0x, kMotorParams, kMotorParams, kRobotParams.gyro);
  static planning::Calibrator calibrator(board.storage());
  static const Params params = calibrated(calibrator);
  static planning::DefaultPlanner planner(params, fuzzy::kDefaultTable);
  static Robot usual(board.rangefinders(), board.drive(), planner.planner, params, &board.bumper(),
                     &board.gyro());
  static SelfCalibration robot(usual, calibrator, kRobotParams, board.button(),
                               {board.rangefinders(), board.drive(), &board.bumper(), &board.gyro()});

  board.start();
  usual.place({});
  usual.set_goal({{2_m, 0_m}, 100_mm});
  for (;;) {
    board.poll(robot.status(), robot.word());
    if (board.due(static_cast<uint32_t>(params.safety.period.raw()))) robot.tick(board.now());
  }
}
