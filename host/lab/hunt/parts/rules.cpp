// A response table goes from the base to the controller and takes effect as a whole; what the assist makes of
// one.
#include <cmath>
#include <memory>

#include "firmware/can/controller_node.hpp"
#include "firmware/can/rules_sender.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/table_store.hpp"
#include "firmware/safety/assist.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/lab/hunt/parts/grid_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using Table = can::RulesSender::Table;

struct Link {
  bus::MemoryBus wire;
  can::RulesServerWith<2> rules{fuzzy::kResponseTable};
  can::BaseNode base{wire.attach(), {1, 11, 0}, 100};
  can::ControllerNode controller{wire.attach(), {1, 22, 0}, &rules};
  std::uint32_t now;
  can::RulesReply reply;
  explicit Link(Dice& dice)
      : now(dice.chance(0.3) ? 0xFFFFFC00U : static_cast<std::uint32_t>(dice.index(100000))) {}
  void pass() {
    ++now;
    base.poll(now);
    controller.poll(now);
  }
  bool send(const Table* table, std::uint8_t upload) {
    can::RulesSender sender(base, table, upload);
    for (int ms = 0; ms < 4000; ++ms) {
      pass();
      sender.poll(now);
      reply = sender.reply();
      if (sender.ended()) return true;
    }
    return false;
  }
};

std::string judge_upload(Dice& dice) {
  auto table = std::make_unique<Table>(fuzzy::kResponseTable);
  for (std::uint16_t i = 0; i < fuzzy::kTableNodes; ++i) {
    if (dice.chance(0.5))
      fuzzy::node_of(*table, i).turn =
          static_cast<decltype(fuzzy::node_of(*table, i).turn)>(dice.index(16385) - 8192);
  }
  const auto link = std::make_unique<Link>(dice);
  if (link->controller.rules() != fuzzy::digest(fuzzy::kResponseTable)) return "other rules at first";
  if (!link->send(table.get(), 1) || link->reply.status != can::RulesStatus::activated)
    return "a table does not arrive";
  for (std::uint16_t i = 0; i < fuzzy::kTableNodes; ++i) {
    const auto &a = fuzzy::node_of(*table, i), &b = fuzzy::node_of(link->rules.active(), i);
    if (a.turn != b.turn || a.step != b.step) return "a table arrives changed";
  }
  for (int i = 0; i < 20; ++i) link->pass();
  if (link->base.peer_rules() != fuzzy::digest(*table) || link->controller.rules() != fuzzy::digest(*table))
    return "other rules are told";
  if (!link->send(nullptr, 2) || link->reply.status != can::RulesStatus::activated)
    return "the built-in table does not come back";
  for (int i = 0; i < 20; ++i) link->pass();
  return link->base.peer_rules() == fuzzy::digest(fuzzy::kResponseTable) ? "" : "other rules after the table";
}

/// To the freer side, in proportion to the speed, and only ahead.
std::string judge_assist(Dice& dice) {
  const Params p;
  const Speed fastest = p.wheels.max_turn_rate * (p.body.track / 2);
  const Pose pose = draw_pose(dice);
  const auto assisted = [&](planning::VelocityRequest asked, double along_m, double left_m, double radius_m,
                            bool& active) {
    LocalGrid grid;
    grid.configure(p);
    grid.reset(pose);
    const auto um = [](double m) { return micrometres(static_cast<std::int32_t>(m * 1e6)); };
    if (radius_m > 0)
      grid.block(pose.at + polar(pose.heading, um(along_m)) + polar(pose.heading + 90_deg, um(left_m)),
                 um(radius_m));
    safety::Assist assist;
    const planning::VelocityRequest bent = assist.step(asked, fastest, pose, grid, p);
    active = assist.active();
    return bent;
  };
  const Speed v = Speed::from_raw(50000 + dice.index(250000)), w = Speed::from_raw(dice.index(40000) - 20000);
  bool active = false;
  planning::VelocityRequest bent = assisted({v, w, true}, 0, 0, 0, active);
  if (active || bent.forward != v || bent.turning != w) return "open ground bends a command";
  const double ahead = dice.uniform(0.19, 0.23),
               aside = dice.uniform(0.05, 0.09) * (dice.chance(0.5) ? 1 : -1);
  bent = assisted({v, {}, true}, ahead, aside, 0.04, active);
  if (bent.turning.raw() * aside > 0 && abs(bent.turning) > v / 40) return "it bends towards an obstacle";
  if (bent.forward > v || bent.forward < Speed{}) return "it asks for more than the operator";
  bool near = false;
  assisted({v, {}, true}, 0.16, aside / 2, 0.02, near);
  if (!near) return "what is near ahead bends nothing";
  const planning::VelocityRequest half = assisted({v / 2, {}, true}, ahead, aside, 0.04, active);
  if (std::abs(half.turning.raw() * 2 - bent.turning.raw()) > 1000 + std::abs(bent.turning.raw()) / 8)
    return "it bends out of proportion";
  const planning::VelocityRequest both = assisted({v, w, true}, ahead, aside, 0.04, active);
  if (std::abs((both.turning - bent.turning - w).raw()) > 400 && abs(both.turning) < fastest &&
      abs(bent.turning) < fastest)
    return "bend and turning do not add up";
  bent = assisted({v, {}, true}, -0.2, aside, 0.04, active);
  if (active || bent.turning != Speed{}) return "what lies behind bends";
  bent = assisted({-v, w, true}, ahead, aside, 0.04, active);
  if (active || bent.forward != -v || bent.turning != w) return "it bends backwards";
  bent = assisted({{}, w, true}, ahead, aside, 0.04, active);
  return active || bent.turning != w ? "it bends a turn on the spot" : "";
}

}  // namespace

std::string judge_rules(Dice& dice) {
  for (int i = 0; i < 5; ++i) {
    std::string wrong = judge_assist(dice);
    if (!wrong.empty()) return wrong;
  }
  return judge_upload(dice);
}

}  // namespace whisker::hunt
