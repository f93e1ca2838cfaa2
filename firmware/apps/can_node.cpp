// The controller of a robot as a node of a CAN bus, behind the board's UART: it looks like an SLCAN adapter.
#include "firmware/apps/can/controller.hpp"
#include "firmware/apps/can/line_node.hpp"
#include "firmware/apps/planner.hpp"
#include "hal/ports/slcan/slcan.hpp"

// Response tables of a base for which the chip has room: 0 to 2.
#ifndef WHISKER_RULES_ROOMS
#define WHISKER_RULES_ROOMS 2
#endif

using namespace whisker;

namespace {

StaticStorage<sizeof(images::Planner)> room_for_planner;
StaticStorage<sizeof(hal::slcan::Slcan)> room_for_port;
StaticStorage<sizeof(can_app::Controller)> room_for_controller;

#if WHISKER_RULES_ROOMS > 0
using Rules = can::RulesServerWith<WHISKER_RULES_ROOMS>;
StaticStorage<sizeof(Rules)> room_for_rules;
Rules* rules = nullptr;

can::RulesServer* start_rules() noexcept { return rules = &room_for_rules.make<Rules>(fuzzy::kDefaultTable); }
const fuzzy::Engine::Table& table() noexcept { return rules->active(); }
#else
can::RulesServer* start_rules() noexcept { return nullptr; }
const fuzzy::Engine::Table& table() noexcept { return fuzzy::kDefaultTable; }
#endif

struct Planners final : can_app::PlannerMaker {
  planning::Planner& make(const Params& params) noexcept override {
    return room_for_planner.make<images::Planner>(params, table()).planner;
  }
};

Planners planners;

}  // namespace

int main() {
  const hal::Board& board = hal::board();
  const can::Identity identity = can_app::identity_behind_line(board);
  auto& port = room_for_port.make<hal::slcan::Slcan>(*board.line, hal::slcan::Role::adapter);
  auto& controller = room_for_controller.make<can_app::Controller>(port, identity, planners, start_rules());
  for (;;) controller.poll(board.clock.now_ms());
}
