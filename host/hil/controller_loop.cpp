#include "host/hil/controller_loop.hpp"

#include "firmware/apps/can/controller.hpp"
#include "host/hil/error_names.hpp"
#include "host/hil/planners.hpp"
#include "host/hil/wall_clock.hpp"

namespace whisker::hil {
namespace {

std::string words_for(const can::Node& node, const Line& line) {
  switch (node.state()) {
    case can::NodeState::off_bus: {
      const std::string what = line.waits_for();
      return what.empty() ? "waits for the bus" : "waits for " + what;
    }
    case can::NodeState::waiting:
      return (node.errors() & can::Error::wrong_version) != 0 ? "the base speaks another protocol"
                                                              : "waits for the base";
    case can::NodeState::ready: return "waits for a mission";
    case can::NodeState::running: return "drives";
    case can::NodeState::safe_stop: return "safe stop: " + error_names(node.errors());
    case can::NodeState::e_stopped: return "E-stop";
  }
  return "";
}

}  // namespace

void control(hal::CanPort& port, Line& line, const ControllerOptions& options) {
  HostPlanners usual(options.planner);
  can_app::PlannerMaker& planners = options.planners != nullptr ? *options.planners : usual;
  can::Identity identity = options.identity;
  if (options.planners == nullptr) identity.rules = rules_digest(options.planner);
  const auto controller = std::make_unique<can_app::Controller>(port, identity, planners);
  WallClock clock([&line] { return line.descriptor(); });
  std::string said;
  while (!options.interrupted()) {
    controller->poll(clock.now_ms());
    const std::string words = words_for(controller->node(), line);
    if (words != said && options.say) options.say(words);
    said = words;
    if (controller->node().lockstep()) {
      clock.wait(Clock::kNap_us);
    } else {
      clock.wait_a_ms();
    }
  }
}

}  // namespace whisker::hil
