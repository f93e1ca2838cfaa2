// A base sends its response table over a bus that loses, repeats, corrupts and delays frames.
#include "firmware/can/rules_sender.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "firmware/can/controller_node.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/bus/scripted_node.hpp"
#include "host/harness/hil/host_rules.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/can/loop.hpp"
#include "tests/can/rules_tables.hpp"

namespace whisker::can {
namespace {

using fuzzy::kResponseTable;
using fuzzy::kTableNodes;
using test::same;
using Table = RulesSender::Table;

Table straight() {
  Table table = kResponseTable;
  for (std::uint16_t i = 0; i < kTableNodes; ++i) fuzzy::node_of(table, i).turn = 0;
  return table;
}

bus::Schedule at_random(bus::FaultKind kind, double chance) {
  bus::Fault fault{kind};
  fault.chance = chance;
  return {fault};
}

/// Both nodes, with the same faults in all directions.
class Link {
 public:
  explicit Link(const bus::Schedule& faults, std::uint64_t seed = 1, std::uint32_t frames_per_ms = 4)
      : wire_(frames_per_ms),
        base_port_(wire_.attach(), faults, seed),
        controller_port_(wire_.attach(), faults, seed + 1) {}

  /// Milliseconds until the sender has ended; most: it has not.
  int send(const Table* table, std::uint8_t upload, int most) {
    RulesSender sender(base, table, upload);
    for (int ms = 0; ms < most; ++ms) {
      pass();
      sender.poll(now_);
      reply = sender.reply();
      if (sender.ended()) return ms;
    }
    return most;
  }
  void pass() {
    ++now_;
    base_port_.at_tick(now_ / 10);
    controller_port_.at_tick(now_ / 10);
    base.poll(now_);
    if (controller) controller->poll(now_);
  }
  void restart_controller() {
    controller = nullptr;
    rules = std::make_unique<RulesServerWith<2>>(kResponseTable);
    controller = std::make_unique<ControllerNode>(controller_port_, Identity{1, ++boot_, 0}, rules.get());
  }

 private:
  bus::MemoryBus wire_;
  bus::FaultPort base_port_, controller_port_;
  std::uint32_t now_ = 0;
  std::uint16_t boot_ = 100;

 public:
  std::unique_ptr<RulesServerWith<2>> rules = std::make_unique<RulesServerWith<2>>(kResponseTable);
  BaseNode base{base_port_, {1, 11, 0}, 100};
  std::unique_ptr<ControllerNode> controller =
      std::make_unique<ControllerNode>(controller_port_, Identity{1, 22, 0}, rules.get());
  RulesReply reply;
};

TEST(RulesSender, TakesASecondAt500KbitPerSecond) {
  const Table table = straight();
  Link link({});
  const int ms = link.send(&table, 1, 10000);
  EXPECT_EQ(link.reply.status, RulesStatus::activated);
  EXPECT_TRUE(same(link.rules->active(), table));
  EXPECT_LT(ms, 1200);
  EXPECT_GT(ms, kTableNodes / 4);
  for (int i = 0; i < 20; ++i) link.pass();
  EXPECT_EQ(link.base.peer_rules(), fuzzy::digest(table));
  EXPECT_LT(link.send(&table, 2, 10000), 20) << "the controller has it already";
}

TEST(RulesSender, RestoresTheBuiltInTable) {
  const Table table = straight();
  Link link({});
  link.send(&table, 1, 10000);
  EXPECT_LT(link.send(nullptr, 2, 1000), 20);
  EXPECT_EQ(link.reply.status, RulesStatus::activated);
  EXPECT_EQ(&link.rules->active(), &kResponseTable);
}

TEST(RulesSender, ArrivesWholeOverEveryFaultyBus) {
  using bus::FaultKind;
  const Table table = straight();
  const struct {
    FaultKind kind;
    double chance;
  } faults[] = {{FaultKind::loss, 0.01},    {FaultKind::loss, 0.2},     {FaultKind::duplicate, 0.5},
                {FaultKind::reorder, 0.05}, {FaultKind::corrupt, 0.05}, {FaultKind::wrong_size, 0.05}};
  for (const auto& fault : faults) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Link link(at_random(fault.kind, fault.chance), seed);
      ASSERT_LT(link.send(&table, 1, 300000), 300000) << static_cast<int>(fault.kind) << ", seed " << seed;
      EXPECT_EQ(link.reply.status, RulesStatus::activated);
      EXPECT_TRUE(same(link.rules->active(), table));
    }
  }
}

// As after a repetition that crossed its answer.
TEST(RulesSender, ABlockThatIsAnsweredTwiceIsNotFollowedByTwo) {
  const Table table = straight();
  bus::MemoryBus wire;
  BaseNode base(wire.attach(), {1, 11, 0}, 100);
  bus::ScriptedNode controller(wire, 1);
  RulesSender sender(base, &table, 1);
  std::uint32_t now = 0;
  const auto parts_after = [&](const RulesReply& reply) {
    controller.forget();
    controller.say(reply);
    for (const std::uint32_t end = now + kRulesRepeat_ms / 2; now < end; ++now) {
      base.poll(now);
      sender.poll(now);
      controller.poll(now);
    }
    return controller.heard<RulesPart>();
  };
  controller.greet(7);
  ASSERT_EQ(parts_after({RulesStatus::incomplete, 1}), kRulesBlock);
  ASSERT_EQ(parts_after({RulesStatus::receiving, 1, 0, 8}), kRulesBlock);
  EXPECT_EQ(parts_after({RulesStatus::receiving, 1, 0, 8}), 0);
  EXPECT_EQ(parts_after({RulesStatus::receiving, 1, 0, 13}), 3) << "the rest of a block whose part was lost";
  EXPECT_EQ(parts_after({RulesStatus::receiving, 1, 0, 0}), kRulesBlock) << "a controller that restarted";
}

TEST(RulesSender, BeginsAgainAtAControllerThatRestarts) {
  const Table table = straight();
  for (const int after : {50, 300, 450}) {
    Link link({});
    EXPECT_EQ(link.send(&table, 1, after), after);
    link.restart_controller();
    ASSERT_LT(link.send(&table, 1, 10000), 10000);
    EXPECT_EQ(link.reply.status, RulesStatus::activated);
    EXPECT_TRUE(same(link.rules->active(), table));
  }
}

// It restarts while the same sender goes on.
TEST(RulesSender, GoesBackToWhatTheControllerHas) {
  const Table table = straight();
  Link link({});
  RulesSender sender(link.base, &table, 1);
  std::uint32_t now = 0;
  for (; now < 20000 && !sender.ended(); ++now) {
    if (now == 300) link.restart_controller();
    link.pass();
    sender.poll(now);
  }
  EXPECT_LT(now, 3000U);
  EXPECT_EQ(sender.reply().status, RulesStatus::activated);
  EXPECT_TRUE(same(link.rules->active(), table));
}

TEST(RulesSender, AForgedPartIsTheWrongHash) {
  const Table table = straight();
  Link link({});
  for (std::uint16_t i = 0; i < kTableNodes; ++i) link.rules->take({3, i, fuzzy::node_of(kResponseTable, i)});
  link.send(&table, 3, 10000);
  EXPECT_EQ(link.reply.status, RulesStatus::wrong_hash);
  EXPECT_EQ(&link.rules->active(), &kResponseTable);
}

/// A run whose base has another table than the controller's built-in one.
class PlantWithRules : public testing::Test {
 protected:
  Scenario scenario_ = [] {
    worlds::Options options;
    options.seed = 3;
    Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    scenario.robot.boundary.bend = Fitted::yes;
    return scenario;
  }();
  const Table table_ = straight();
  hil::Figures figures_;

  RunResult drive(bool takes_tables, double loss) {
    bus::MemoryBus wire;
    bus::FaultPort base(wire.attach(), at_random(bus::FaultKind::loss, loss), 1);
    hil::HostRules rules(kDefaultPlanner);
    hil::HostPlanners planners(kDefaultPlanner, &rules);
    can_app::Controller controller(wire.attach(), {1, 77, 0, rules_digest(kDefaultPlanner)}, planners,
                                   takes_tables ? rules.server() : nullptr);
    test::SharedTime time([&](std::uint32_t now_ms) { controller.poll(now_ms); });
    hil::BusOptions bus;
    bus.resend_ms = 3;
    bus.rules = fuzzy::digest(table_);
    bus.table = &table_;
    RunOptions options;
    options.pilot = hil::bus_pilot(base, time, bus, figures_);
    return run(scenario_, options);
  }
};

TEST_F(PlantWithRules, DrivesAsInOneProcess) {
  RunOptions direct;
  direct.planner.table = &table_;
  const RunResult here = run(scenario_, direct);
  EXPECT_NE(here.hash, run(scenario_).hash);
  for (const double loss : {0.0, 0.02}) EXPECT_EQ(drive(true, loss).hash, here.hash) << loss;
}

TEST_F(PlantWithRules, RefusesAControllerThatTakesNone) {
  try {
    drive(false, 0);
    FAIL() << "it drove";
  } catch (const hil::OtherRules& e) {
    EXPECT_NE(std::string(e.what()).find("and takes no other; start it with the same --rules"),
              std::string::npos)
        << e.what();
  }
  EXPECT_EQ(figures_.sets, 0U);
}

}  // namespace
}  // namespace whisker::can
