// The controller of a robot as a node of a CAN bus, on an STM32F405. Its flash keeps the response table that
// a base sends, and the calibration that a base orders.
#include "firmware/apps/can/keeping_controller.hpp"
#include "firmware/version.hpp"
#include "hal/boards/stm32f405/node_board.hpp"

int main() {
  using namespace whisker;
  static hal::stm32f405::NodeBoard board;
  board.start();
  static can_app::KeepingController node(board.can(), {1, board.boot_number(), kVersionNumber},
                                         board.tables(), board.calibration());
  can_app::Controller& controller = node.controller();
  board.watch();
  for (;;) {
    board.report(controller.status());
    if (board.due(1)) controller.poll(board.now_ms());
  }
}
