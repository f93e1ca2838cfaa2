// A guard node of a CAN bus, behind the board's UART: it looks like an SLCAN adapter. docs/guard.md.
#include "firmware/apps/can/guard_controller.hpp"
#include "firmware/apps/can/line_node.hpp"
#include "hal/ports/slcan/slcan.hpp"

using namespace whisker;

namespace {

StaticStorage<sizeof(hal::slcan::Slcan)> room_for_port;
StaticStorage<sizeof(can_app::GuardController)> room_for_controller;

}  // namespace

int main() {
  const hal::Board& board = hal::board();
  const can::Identity identity = can_app::identity_behind_line(board);
  auto& port = room_for_port.make<hal::slcan::Slcan>(*board.line, hal::slcan::Role::adapter);
  auto& controller = room_for_controller.make<can_app::GuardController>(port, identity);
  for (;;) controller.poll(board.clock.now_ms());
}
