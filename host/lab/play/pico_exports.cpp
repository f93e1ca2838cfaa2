/// The functions that host/lab/web/src/playground/pico_worker.mjs calls besides those of exports.cpp. Text
/// passes through a buffer: `text` allocates it, and functions that return a length fill it.
#include <string>

#include "firmware/can/headers.hpp"
#include "host/harness/scenario/nearest.hpp"
#include "host/lab/play/exports.hpp"
#include "host/lab/play/flat.hpp"
#include "host/lab/play/pico_robot.hpp"

namespace whisker::play {
namespace {

std::string said;
PicoRobot* driven = nullptr;

int answer(std::string text) {
  said = std::move(text);
  return static_cast<int>(said.size());
}

}  // namespace

WHISKER_EXPORT(text) char* text(int count) {
  said.resize(static_cast<std::size_t>(count));
  return said.data();
}

/// Puts the Pico's robot on side 0 into the scenario in the list; 0: it would touch an obstacle.
WHISKER_EXPORT(begin_pico) int begin_pico() {
  const std::optional<Scenario> world = scenario_of(exchanged);
  if (!world) return 0;
  const Scenario scenario = with_pico(*world);
  if (!start_is_free(scenario)) return 0;
  auto robot = std::make_unique<PicoRobot>(scenario);
  driven = robot.get();
  robots[0] = std::move(robot);
  return 1;
}

/// A millisecond: the text is a line of the board, and becomes the answer.
WHISKER_EXPORT(ask) int ask() { return answer(driven->step(said)); }
WHISKER_EXPORT(verdict) int verdict() { return answer(driven->rig().verdict()); }

/// The name of the message with this identifier on the bus; empty: there is none.
WHISKER_EXPORT(message) int message(std::uint32_t id) {
  can::MessageKind kind = can::MessageKind::e_stop;
  return answer(can::kind_of(id, kind) ? can::message_of(kind).name : "");
}

}  // namespace whisker::play
