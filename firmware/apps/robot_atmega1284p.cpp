// The reference robot on an ATmega328P: drives 1.5 m ahead and stands.
#include "firmware/planning/thesis/thesis_planner.hpp"
#include "hal/boards/atmega1284p/robot_board.hpp"
#include "hal/boards/atmega1284p/robot_params.hpp"

int main() {
  using namespace whisker;
  using namespace whisker::hal::atmega1284p;
  static RobotBoard board(kMotorParams, kMotorParams);
  static planning::ThesisPlanner planner(kRobotParams, fuzzy::kDefaultTable);
  static Robot robot(board.rangefinders(), board.drive(), planner, kRobotParams);

  board.start();
  robot.place({});
  robot.set_goal({{1500_mm, 0_mm}, 100_mm});
  for (;;) {
    board.poll();
    if (board.due(static_cast<uint8_t>(kRobotParams.safety.period.raw())))
      board.show(robot.tick(board.now()));
  }
}
