// A controller on the bus whose flash keeps what a base sends and orders: the whole program but its start-up,
// on models of the chip.
#include <algorithm>
#include <string>

#include "host/harness/run/pilot.hpp"
#include "tests/boards/can_node_fixture.hpp"

namespace whisker::hal::test {
namespace {

using calibration::Quantity;
using calibration::Stored;
using calibration::Values;
using fuzzy::kDefaultTable;
using fuzzy::kTableNodes;
using Table = fuzzy::Bilinear::Table;

constexpr int kWordsOfTable = fuzzy::kTableRecordBytes / 4;

/// Turns much, at this pace.
Table another(std::int16_t step) {
  Table table{};
  for (std::uint16_t i = 0; i < kTableNodes; ++i) {
    const std::int16_t turn = kDefaultTable.node[i / 57][i % 57].turn;
    fuzzy::node_of(table, i) = {static_cast<std::int16_t>(-turn), step};
  }
  return table;
}

Values some_values() {
  Values values;
  values[Quantity::wheel_ratio] = {1003000, millionths(90)};
  return values;
}

TEST_F(CanNodeTest, ATableOfABaseIsKeptOverAPowerCut) {
  unit->memory.model.erase_accesses = kEraseOf2s;
  double timeout_ms = 0;
  unit->memory.model.on_erase = [&] { timeout_ms = unit->iwdg.timeout_ms(); };
  connect();
  EXPECT_EQ(table_of_greeting(), fuzzy::digest(kDefaultTable));
  const Table table = another(4915);
  const can::RulesReply reply = send_table(&table);
  EXPECT_EQ(reply.status, can::RulesStatus::activated);
  EXPECT_EQ(reply.kept, 1);
  EXPECT_EQ(base.errors(), 0) << "the silence stops nobody who stands";
  EXPECT_EQ(base.peer_rules(), fuzzy::digest(table)) << "the Info comes by itself";
  EXPECT_EQ(unit->memory.model.erasures[8] + unit->memory.model.erasures[9], 1);
  EXPECT_EQ(unit->memory.model.erasures[10] + unit->memory.model.erasures[11], 0);
  // The oscillator of the watchdog may be 47 kHz instead of 32.
  EXPECT_GT(timeout_ms * 32 / 47, 2000);
  EXPECT_LT(unit->iwdg.hungriest, 32.0 / 47);
  EXPECT_NEAR(unit->iwdg.timeout_ms(), NodeBoard::kWatchdogMs, 1);

  power_up();
  pass(500);
  EXPECT_EQ(base.peer_restarts(), 1U);
  EXPECT_EQ(table_of_greeting(), fuzzy::digest(table));
  EXPECT_EQ(unit->program->loaded(), Stored::ok);
  unit->memory.model.erase_accesses = kEraseOf2s;
  EXPECT_EQ(send_table(nullptr).kept, 1);
  power_up();
  pass(500);
  EXPECT_EQ(table_of_greeting(), fuzzy::digest(kDefaultTable));
}

/// Commands of the base's wheels in lockstep, or of the core in this process.
class Drives : public CanNodeTest {
 protected:
  static constexpr int kTicks = 800;
  Drives() { scenario.robot.boundary.bend = Fitted::yes; }
  sim::Plant plant() { return {world.view(), robot_spec(scenario), {}, 1, scenario.start}; }
  std::vector<WheelSpeeds> through_the_chip() {
    sim::Plant robot = plant();
    SimBoard sensors(robot);
    can_app::Base node(base, sensors, sensors);
    base.give(can::Order::start, {fixed_pose(scenario.start), fixed_goal(scenario.goal)},
              can::SyncMode::lockstep);
    EXPECT_TRUE(pass(100, [this] { return base.order_state() == can::OrderState::accepted; }));
    std::vector<WheelSpeeds> commands;
    for (std::uint32_t tick = 0; tick < kTicks; ++tick) {
      node.measure(tick, 10);
      node.publish(can::SyncMode::lockstep);
      EXPECT_TRUE(pass(50, [&] { return base.answered(tick); }));
      commands.push_back(node.drive());
      robot.advance();
    }
    return commands;
  }
  std::vector<WheelSpeeds> of_the_core(const Table& table) {
    sim::Plant body = plant();
    SimBoard sensors(body);
    planning::DefaultPlanner planner(scenario.robot, table);
    Robot robot(sensors, sensors, planner.planner, scenario.robot);
    robot.place(fixed_pose(scenario.start));
    robot.set_goal(fixed_goal(scenario.goal));
    std::vector<WheelSpeeds> commands;
    for (std::uint32_t tick = 0; tick < kTicks; ++tick) {
      robot.tick(Time::from_raw(tick * 10));
      commands.push_back(robot.status().command);
      body.command(robot.status().command);
      body.advance();
    }
    return commands;
  }
  static bool same(const std::vector<WheelSpeeds>& a, const std::vector<WheelSpeeds>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](WheelSpeeds x, WheelSpeeds y) { return x.left == y.left && x.right == y.right; });
  }

  Scenario scenario = parse_scenario(R"(
name = "disc"
[start]
x_m = 0.0
y_m = 0.0
[goal]
x_m = 3.0
y_m = 0.0
[[disc]]
center = [1.0, 0.1]
radius_m = 0.1
)",
                                     "disc.toml");
  SimWorld world{scenario};
};

TEST_F(Drives, WithTheKeptTableAfterThePowerCut) {
  connect();
  const Table table = another(4915);
  ASSERT_EQ(send_table(&table).kept, 1);
  power_up();
  pass(500);
  send_params(scenario.robot);
  const auto commands = through_the_chip();
  EXPECT_TRUE(same(commands, of_the_core(table)));
  EXPECT_FALSE(same(commands, of_the_core(kDefaultTable)));
}

TEST_F(CanNodeTest, AFlashThatFailsIsSaidAndErasedOnce) {
  connect();
  unit->memory.model.erase_accesses = kEraseOf2s;
  unit->memory.model.power = 0;
  const Table table = another(4915);
  const can::RulesReply reply = send_table(&table);
  EXPECT_EQ(reply.status, can::RulesStatus::activated);
  EXPECT_EQ(reply.kept, 0);
  pass(500);
  EXPECT_EQ(unit->memory.model.erasures[8] + unit->memory.model.erasures[9], 1);
  EXPECT_EQ(table_of_greeting(), fuzzy::digest(table)) << "it drives with it until the power fails";
}

TEST_F(CanNodeTest, APowerCutWhileATableIsSavedLeavesTheOldOneOrTheNewOne) {
  ASSERT_EQ(calibration::Store(unit->board.calibration()).save(some_values()), Stored::ok);
  connect();
  std::uint32_t old = fuzzy::digest(kDefaultTable);
  std::int16_t step = 3000;
  for (const int power : {0, 1, 2, kWordsOfTable / 2, kWordsOfTable, kWordsOfTable + 1}) {
    const Table table = another(++step);
    unit->memory.model.power = power;
    const bool whole = power > kWordsOfTable;
    EXPECT_EQ(send_table(&table).kept, whole ? 1 : 0) << power;
    power_up();
    pass(500);
    EXPECT_EQ(table_of_greeting(), whole ? fuzzy::digest(table) : old) << power;
    EXPECT_EQ(unit->program->calibrator().values(), some_values()) << power;
    // The next cut meets a kept table.
    if (power != 1) continue;
    const Table kept = another(++step);
    ASSERT_EQ(send_table(&kept).kept, 1);
    old = fuzzy::digest(kept);
  }
}

/// A base as bus_pilot.hpp: it resumes what a safe stop interrupts, until it knows that the mission has
/// ended.
TEST_F(CanNodeTest, ACalibrationIsSavedOnceTheBaseKnowsItsEndAndBothStoresStay) {
  Scenario robot;
  apply_robot_file(robot, WHISKER_SOURCE_DIR "/host/robots/gyro.toml");
  // So that PoseSigma comes before the answer, which then is longer than the mailboxes are deep.
  robot.robot.pose_error.wheel_scale = robot.robot.pose_error.wheel_scale_common = millionths(5000);
  connect();
  const Table table = another(4915);
  ASSERT_EQ(send_table(&table).kept, 1);
  send_params(robot.robot);
  unit->memory.model.erase_accesses = kEraseOf2s;

  SimWorld world(robot);
  sim::RobotSpec spec = robot_spec(robot);
  spec.wheel_ratio *= 1.01;
  sim::Plant plant(world.view(), spec, {}, 1, {});
  SimBoard sensors(plant);
  can_app::Base node(base, sensors, sensors, nullptr, &sensors);
  const can::Mission mission{{}, {{500_mm, 0_mm}, 100_mm}};
  base.give(can::Order::straight, mission, can::SyncMode::real_time);
  int resumed = 0;
  std::uint32_t tick = 0;
  const auto ended = [&] { return base.status().outcome > planning::Outcome::running; };
  for (; tick < 6000 && !ended(); ++tick) {
    node.measure(tick, 10);
    node.publish(can::SyncMode::real_time);
    pass(10);
    node.drive();
    plant.advance();
    if (base.state() != can::NodeState::safe_stop || !base.matched()) continue;
    base.give(can::Order::resume, mission, can::SyncMode::real_time);
    ++resumed;
  }
  ASSERT_TRUE(ended());
  EXPECT_EQ(resumed, 0);
  can::Calibrated found;
  ASSERT_TRUE(pass(10000, [&] { return base.calibrated(found); }));
  EXPECT_EQ(found.trouble, planning::Trouble::none) << name(found.trouble);
  EXPECT_EQ(found.stored, Stored::ok);
  EXPECT_NEAR(found[Quantity::wheel_ratio].value, 1010000, 2000);
  EXPECT_EQ(unit->memory.model.erasures[10] + unit->memory.model.erasures[11], 1);
  EXPECT_LT(unit->iwdg.hungriest, 32.0 / 47);

  power_up();
  pass(500);
  EXPECT_EQ(unit->program->calibrator().values(), static_cast<const Values&>(found));
  EXPECT_EQ(table_of_greeting(), fuzzy::digest(table));
}

TEST_F(CanNodeTest, EachStartHasAnotherBootNumber) {
  const std::uint16_t first = unit->boot;
  power_up();
  EXPECT_NE(unit->boot, first);
  EXPECT_EQ(unit->board.troubles().of(stm32f405::Trouble::random_not_ready), 0U);
  for (const bool dead : {true, false}) {
    PoweredNode silent({}, 1);
    silent.rng.dead = dead;
    silent.rng.stuck = true;
    silent.start();
    EXPECT_EQ(silent.board.troubles().of(stm32f405::Trouble::random_not_ready), 1U);
    EXPECT_NE(silent.boot, 0) << "the time";
  }
}

TEST_F(CanNodeTest, WithoutItsCanControllerItStaysOffTheBusAndGoesOn) {
  unit.reset();
  PoweredNode alone({}, 1);
  alone.can.dead = true;
  alone.start();
  EXPECT_LT(alone.chip.now_us(), 20000);
  while (alone.now_ms() < 2500) alone.pass();
  EXPECT_EQ(alone.program->controller().node().state(), can::NodeState::off_bus);
  EXPECT_NE(alone.usart.sent.find("can not_started"), std::string::npos) << alone.usart.sent;
  EXPECT_LT(alone.iwdg.hungriest, 32.0 / 47);
  EXPECT_EQ(alone.tim1.duty(1), 0);
  EXPECT_EQ(alone.tim1.duty(2), 0);
}

}  // namespace
}  // namespace whisker::hal::test
