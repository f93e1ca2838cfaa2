// The controller of a robot as a node of a CAN bus, behind the board's UART: it looks like an SLCAN adapter.
#include "firmware/apps/can/controller.hpp"
#include "firmware/apps/planner.hpp"
#include "firmware/fuzzy/digest.hpp"
#include "firmware/version.hpp"
#include "hal/board.hpp"
#include "hal/ports/slcan/slcan.hpp"

using namespace whisker;

namespace {

StaticStorage<sizeof(images::Planner)> room_for_planner;
StaticStorage<sizeof(hal::slcan::Slcan)> room_for_port;
StaticStorage<sizeof(can_app::Controller)> room_for_controller;

struct Planners final : can_app::PlannerMaker {
  planning::Planner& make(const Params& params) noexcept override {
    return room_for_planner.make<images::Planner>(params, fuzzy::kDefaultTable).planner;
  }
};

Planners planners;

/// Between two starts, only the instant of the other end's first byte differs.
uint16_t boot_number(const hal::Board& board) noexcept {
  uint8_t byte = 0;
  while (board.line->take(&byte, 1) == 0) {
  }
  const uint32_t instant = board.meter.stamp();
  return static_cast<uint16_t>(instant ^ instant >> 16);
}

}  // namespace

int main() {
  const hal::Board& board = hal::board();
  const can::Identity identity{1, boot_number(board), kVersionNumber, fuzzy::digest(fuzzy::kDefaultTable)};
  auto& port = room_for_port.make<hal::slcan::Slcan>(*board.line, hal::slcan::Role::adapter);
  auto& controller = room_for_controller.make<can_app::Controller>(port, identity, planners);
  for (;;) controller.poll(board.clock.now_ms());
}
