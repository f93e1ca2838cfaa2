// A whole robot on a Raspberry Pi Pico. Its USB and its serial line are nodes of a CAN bus: `whisker bench
// --tty` gives it goals and parameters.
#include "firmware/apps/can/whole_robot.hpp"
#include "hal/boards/pico/robot_board.hpp"
#include "hal/ports/slcan/slcan.hpp"
#include "hal/ports/two_ports.hpp"

namespace {

uint16_t pattern_of(whisker::can_app::Sign sign) noexcept {
  using whisker::can_app::Sign;
  using whisker::hal::pico::Led;
  switch (sign) {
    case Sign::starts: return Led::kShort;
    case Sign::rests: return Led::kSlow;
    case Sign::drives: return Led::kOn;
    case Sign::calibrates: return Led::kDouble;
    case Sign::failed: return Led::kFast;
  }
  return Led::kOff;
}

}  // namespace

int main() {
  using namespace whisker;
  using namespace whisker::hal::pico;
  static_assert(check(kRobotParams) == ParamFault::none);
  static RobotBoard board;
  if (!board.start()) board.refuse();
  static hal::slcan::Slcan line(board.line(), hal::slcan::Role::adapter);
  static hal::slcan::Slcan usb(board.usb(), hal::slcan::Role::adapter);
  static hal::TwoPorts<hal::slcan::Slcan> cables(line, usb);
  static can_app::WholeRobot robot(
      cables, board.boot_number(), kRobotParams,
      {board.rangefinders(), board.drive(), board.button(), &board.bumper(), &board.gyro()},
      {board.storage(FlashUse::response_table), board.storage(FlashUse::calibration),
       board.storage(FlashUse::parameters)});
  board.adopt(robot.params());
  board.watch();
  for (;;) {
    board.sleep();
    board.poll();
    const uint32_t now = board.now_ms();
    if (robot.poll(now)) board.adopt(robot.params());
    board.led().show(pattern_of(robot.sign()), now);
    if (!board.due(static_cast<uint32_t>(robot.params().safety.period.raw()))) continue;
    board.mark_tick(true);
    robot.tick(board.now_ms());
    board.mark_tick(false);
  }
}
