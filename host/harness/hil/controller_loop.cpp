#include "host/harness/hil/controller_loop.hpp"

#include <fmt/format.h>

#include "firmware/apps/can/controller.hpp"
#include "firmware/apps/can/guard_controller.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/planners.hpp"
#include "host/harness/hil/wall_clock.hpp"

namespace whisker::hil {
namespace {

std::string words_for(const can::Node& node, const Line& line) {
  const std::string what = line.waits_for();
  switch (node.state()) {
    case can::NodeState::off_bus: return "waits for " + (what.empty() ? "the bus" : what);
    case can::NodeState::waiting:
      if ((node.errors() & can::Error::wrong_version) != 0) return "the base speaks another protocol";
      return "waits for the base" + (what.empty() ? "" : ", and for " + what);
    case can::NodeState::ready: return "waits for a mission";
    case can::NodeState::running: return "drives";
    case can::NodeState::safe_stop: return "safe stop: " + error_names(node.errors());
    case can::NodeState::e_stopped: return "E-stop";
  }
  return "";
}

/// rules: the response table that is not announced.
template <class Controller>
void run(Controller& controller, std::uint32_t rules, hal::CanPort& port, Line& line,
         const ControllerOptions& options) {
  WallClock clock([&line] { return line.descriptor(); });
  std::string said;
  std::uint32_t rules_said = rules;
  while (!options.interrupted()) {
    const bool stepped = controller.poll(clock.now_ms());
    // On a busy computer, what was said in this poll would expire before the next one. In lockstep, the
    // frames that a poll takes before a wait cost time.
    if (stepped || !controller.node().lockstep()) port.poll(clock.now_ms());
    const std::string words = words_for(controller.node(), line);
    if (words != said && options.say) options.say(words);
    said = words;
    const std::uint32_t hash = controller.node().rules();
    if (hash != rules_said && options.say) options.say(fmt::format("response table {:08x}", hash));
    rules_said = hash;
    if (controller.node().lockstep()) {
      clock.wait(Clock::kNap_us);
    } else {
      clock.wait_a_ms();
    }
  }
}

}  // namespace

void control(hal::CanPort& port, Line& line, const ControllerOptions& options) {
  HostRules rules(options.planner, options.storage);
  HostPlanners usual(options.planner, &rules);
  const bool own = options.planners == nullptr;
  can_app::PlannerMaker& planners = own ? usual : *options.planners;
  can::Identity identity = options.identity;
  if (own) identity.rules = rules_digest(options.planner);
  if (options.guard) {
    const auto guard = std::make_unique<can_app::GuardController>(port, identity, options.longest_command);
    if (options.assist != nullptr) guard->assist_by(*options.assist);
    return run(*guard, identity.rules, port, line, options);
  }
  const auto controller = std::make_unique<can_app::Controller>(
      port, identity, planners, own ? rules.server() : nullptr, options.calibrator);
  run(*controller, identity.rules, port, line, options);
}

}  // namespace whisker::hil
