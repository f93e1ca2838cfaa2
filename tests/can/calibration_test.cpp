// A controller that calibrates: orders of the base over a bus in memory, the core's drives, and its storage.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "firmware/apps/can/base.hpp"
#include "firmware/apps/can/controller.hpp"
#include "host/harness/bus/memory_bus.hpp"
#include "host/harness/hil/planners.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "host/lab/calibration/drive_rig.hpp"
#include "tests/calibration/memory_storage.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

using calibration::Quantity;
using calibration::Stored;
using calibration::Values;
using calibration::WheelErrors;
using can::Order;
using planning::Trouble;

Scenario with_gyro() {
  Scenario s;
  apply_robot_file(s, WHISKER_SOURCE_DIR "/host/robots/gyro.toml");
  return s;
}

/// The base with a simulated robot that is not as its parameters say, and the controller.
class Pair {
 public:
  Pair(const WheelErrors& errors, std::uint64_t seed, test::MemoryStorage& storage)
      : errors_(errors),
        seed_(seed),
        calibrator_(storage),
        controller_(std::make_unique<can_app::Controller>(at_controller_, can::Identity{1, 22, 0}, planners_,
                                                          nullptr, &calibrator_)) {
    pass(50);
    can::each_param(robot_.robot, [this](std::uint8_t index, std::uint32_t raw) {
      node_.request({can::ParamAction::write, index, raw});
      pass(2);
    });
    node_.request({can::ParamAction::commit, 255, 0});
    pass(2);
    can::ParamReply reply;
    EXPECT_TRUE(node_.replied(reply) && reply.index == 255 && reply.status == can::ParamStatus::ok);
  }

  /// Puts the robot into this world and gives the order. Real time.
  void begin(Order order, Scenario world, Length length = 3_m) {
    world.robot = robot_.robot;
    world.sensor = robot_.sensor;
    world_ = std::make_unique<SimWorld>(world);
    sim::RobotSpec spec = robot_spec(world);
    spec.counts_per_m *= errors_.counts_per_m;
    spec.wheel_ratio *= errors_.wheel_ratio;
    spec.track *= errors_.track;
    spec.gyro_range *= errors_.gyro_scale;
    spec.gyro_dies_s = gyro_dies_s;
    Noise noise = robot_.noise;
    noise.wheel_scale_sigma = noise.wheel_scale_common_sigma = noise.gyro_scale_sigma = 0;
    plant_ = std::make_unique<sim::Plant>(world_->view(), spec, noise_spec(noise), seed_, sim::Pose{});
    board_ = std::make_unique<hal::SimBoard>(*plant_);
    base_ = std::make_unique<can_app::Base>(node_, *board_, *board_, nullptr, board_.get());
    tick_ = 0;
    give(order, length);
  }
  void give(Order order, Length length = 3_m) {
    node_.give(order, {{}, {{length, 0_m}, 100_mm}}, can::SyncMode::real_time);
    pass(5);
  }
  void drive(double seconds) {
    for (const std::uint32_t end = tick_ + static_cast<std::uint32_t>(seconds * 100); tick_ < end;) tick();
  }
  /// Until the controller reports what it ended with, 60 s at most.
  can::Calibrated result() {
    can::Calibrated found;
    for (int i = 0; i < 6000 && !node_.calibrated(found); ++i) tick();
    return found;
  }
  can::Calibrated calibrate(Order order, const Scenario& world, Length length = 3_m) {
    begin(order, world, length);
    const can::Calibrated found = result();
    give(Order::cancel);
    return found;
  }

  can::BaseNode& node() { return node_; }
  planning::Calibrator& calibrator() { return calibrator_; }
  const can_app::Controller& controller() const { return *controller_; }
  const sim::Plant& plant() const { return *plant_; }
  const Params& params() const { return robot_.robot; }
  double gyro_dies_s = 1e9;

 private:
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) {
      ++now_;
      node_.poll(now_);
      controller_->poll(now_);
      node_.poll(now_);
    }
  }
  void tick() {
    base_->measure(tick_++, 10);
    base_->publish(can::SyncMode::real_time);
    pass(10);
    base_->drive();
    plant_->advance();
  }

  const WheelErrors errors_;
  const std::uint64_t seed_;
  const Scenario robot_ = with_gyro();
  bus::MemoryBus wire_;
  bus::MemoryPort& at_base_ = wire_.attach();
  bus::MemoryPort& at_controller_ = wire_.attach();
  can::BaseNode node_{at_base_, {1, 11, 0}, 100};
  hil::HostPlanners planners_{kDefaultPlanner};
  planning::Calibrator calibrator_;
  std::unique_ptr<can_app::Controller> controller_;
  std::unique_ptr<SimWorld> world_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<hal::SimBoard> board_;
  std::unique_ptr<can_app::Base> base_;
  std::uint32_t now_ = 0;
  std::uint32_t tick_ = 0;
};

constexpr WheelErrors kWrong{1.02, 0.985, 1, 0.98};

Scenario room(std::uint64_t seed) {
  return calibration::scene(calibration::Scene::room, with_gyro().robot, seed);
}

TEST(CalibrationOnTheBus, SpinAndStraightDriveFindTheTrueValuesAndKeepThem) {
  const std::uint64_t robots = test::effort(3);
  for (std::uint64_t seed = 1; seed <= robots; ++seed) {
    WheelErrors errors = calibration::draw({0.01, 0.005, 0, 0.01}, seed);
    errors.counts_per_m = 1;
    test::MemoryStorage storage;
    Pair pair(errors, seed, storage);
    const can::Calibrated spin = pair.calibrate(Order::spin, room(seed));
    ASSERT_EQ(spin.trouble, Trouble::none) << seed << ": " << name(spin.trouble);
    EXPECT_EQ(spin.stored, Stored::ok);
    EXPECT_FALSE(spin[Quantity::wheel_ratio].known());

    // The same drive without a bus: one arithmetic.
    const Scenario robot = with_gyro();
    calibration::DriveRig rig(robot.robot, robot.sensor, robot.noise, errors, seed);
    const auto planner = std::make_unique<planning::SpinPlanner>(robot.robot);
    ASSERT_TRUE(rig.spin(room(seed), *planner).good()) << seed;
    for (const Quantity q : {Quantity::gyro_scale, Quantity::track}) {
      EXPECT_NEAR(spin[q].value, planner->values()[q].value, 1e-4 * spin[q].value) << seed << name(q);
    }

    const can::Calibrated both = pair.calibrate(Order::straight, {});
    ASSERT_EQ(both.trouble, Trouble::none) << seed << ": " << name(both.trouble);
    EXPECT_EQ(both[Quantity::gyro_scale], spin[Quantity::gyro_scale]) << "a save keeps earlier values";
    for (const Quantity q : {Quantity::gyro_scale, Quantity::wheel_ratio, Quantity::track}) {
      const double error = both[q].value / calibration::true_value(pair.params(), errors, q) - 1;
      EXPECT_LT(std::abs(error), 1e-3) << seed << " " << name(q);
      EXPECT_LT(std::abs(error), 5e-6 * both[q].sigma.raw()) << seed << " " << name(q);
    }
    EXPECT_FALSE(both[Quantity::counts_per_metre].known());
    const planning::Calibrator next(storage);
    EXPECT_EQ(next.stored(), Stored::ok);
    EXPECT_EQ(next.values(), static_cast<const Values&>(both)) << "after the next start";
  }
}

TEST(CalibrationOnTheBus, AMissionDrivesWithWhatIsKept) {
  test::MemoryStorage storage;
  Values values;
  values[Quantity::track] = {141000, millionths(100)};
  ASSERT_EQ(calibration::Store(storage).save(values), Stored::ok);
  Params params = with_gyro().robot;
  const planning::Calibrator kept(storage);
  kept.apply(params);
  EXPECT_EQ(params.body.track.raw(), 141000);
  // A second calibration measures the same true value, although it now drives with the first one's.
  test::MemoryStorage twice;
  Pair pair(kWrong, 4, twice);
  const can::Calibrated first = pair.calibrate(Order::spin, room(4));
  const can::Calibrated second = pair.calibrate(Order::spin, room(4));
  ASSERT_EQ(second.trouble, Trouble::none);
  for (const Quantity q : {Quantity::gyro_scale, Quantity::track}) {
    EXPECT_NEAR(1.0 * second[q].value / first[q].value, 1, 5e-4) << name(q);
  }
}

TEST(CalibrationOnTheBus, WithoutAResultTheOldValuesStayAndTheReasonIsReported) {
  test::MemoryStorage storage;
  Values values;
  values[Quantity::gyro_scale] = {1010000, millionths(70)};
  ASSERT_EQ(calibration::Store(storage).save(values), Stored::ok);
  const auto slots = storage.slots;

  Pair pair(kWrong, 2, storage);
  can::Calibrated found = pair.calibrate(Order::spin, {});
  EXPECT_EQ(found.trouble, Trouble::nothing_in_range) << name(found.trouble);
  EXPECT_EQ(static_cast<const Values&>(found), values);

  Scenario wall;
  wall.walls.push_back({{1, -3}, {1, 3}});
  found = pair.calibrate(Order::straight, wall);
  EXPECT_EQ(found.trouble, Trouble::blocked) << name(found.trouble);
  EXPECT_FALSE(pair.plant().in_contact());

  pair.gyro_dies_s = 5;
  found = pair.calibrate(Order::spin, room(2));
  EXPECT_EQ(found.trouble, Trouble::gyro_lost) << name(found.trouble);
  EXPECT_EQ(static_cast<const Values&>(found), values);
  EXPECT_EQ(storage.slots, slots) << "nothing was written";
}

TEST(CalibrationOnTheBus, ACancelledOneKeepsNothingAndAnotherOrderEndsIt) {
  test::MemoryStorage storage;
  Pair pair(kWrong, 3, storage);
  const auto slots = storage.slots;
  pair.begin(Order::spin, room(3));
  pair.drive(6);
  EXPECT_EQ(pair.node().state(), can::NodeState::running);
  pair.give(Order::cancel);
  pair.drive(30);
  can::Calibrated found;
  EXPECT_FALSE(pair.node().calibrated(found));
  EXPECT_EQ(pair.calibrator().trouble(), Trouble::not_finished);
  pair.begin(Order::spin, room(3));
  pair.drive(6);
  pair.begin(Order::start, room(3), 300_mm);
  pair.drive(30);
  EXPECT_EQ(pair.controller().status().decision.outcome, planning::Outcome::reached);
  EXPECT_FALSE(pair.node().calibrated(found)) << "a mission is no calibration";
  EXPECT_EQ(storage.slots, slots);
}

TEST(CalibrationOnTheBus, ACancelAtOnceAfterItsEndKeepsTheResult) {
  test::MemoryStorage storage;
  Pair pair(kWrong, 9, storage);
  pair.begin(Order::straight, {}, 500_mm);
  const auto& decision = pair.controller().status().decision;
  for (int tick = 0; tick < 3000 && decision.outcome != planning::Outcome::reached; ++tick) pair.drive(0.01);
  EXPECT_FALSE(pair.calibrator().values()[Quantity::wheel_ratio].known())
      << "the base must see the end first";
  pair.give(Order::cancel);
  EXPECT_EQ(pair.calibrator().stored(), Stored::ok);
  EXPECT_TRUE(pair.calibrator().values()[Quantity::wheel_ratio].known());
}

TEST(CalibrationOnTheBus, ASafeStopInTheMiddleCostsASpinAndNothingElse) {
  test::MemoryStorage storage;
  Pair pair(kWrong, 5, storage);
  pair.begin(Order::spin, room(5));
  pair.drive(8);
  pair.give(Order::resume);
  const can::Calibrated found = pair.result();
  EXPECT_EQ(found.trouble, Trouble::none) << name(found.trouble);
  EXPECT_EQ(found.stored, Stored::ok);
  EXPECT_NEAR(found[Quantity::gyro_scale].value, 1020000, 1000);
}

TEST(CalibrationOnTheBus, ATapeFindsTheSizeOfTheWheels) {
  constexpr double kCounts = 1.02;
  test::MemoryStorage storage;
  Pair pair({1, 1, kCounts, 1}, 8, storage);
  const auto read_tape = [&](double metres) {
    pair.give(Order::measured, Length::from_raw(static_cast<std::int32_t>(std::lround(metres * 1e6))));
    return pair.result();
  };
  pair.begin(Order::tape, {});
  EXPECT_EQ(read_tape(3).trouble, Trouble::no_drive) << "nothing is driven yet";

  const auto drive = [&] {
    pair.begin(Order::tape, {});
    pair.drive(25);
    EXPECT_EQ(pair.controller().status().decision.outcome, planning::Outcome::reached);
    can::Calibrated none;
    EXPECT_FALSE(pair.node().calibrated(none)) << "a drive alone tells nothing";
    return pair.plant().pose().at.x;
  };
  const can::Calibrated found = read_tape(drive());
  ASSERT_EQ(found.trouble, Trouble::none) << name(found.trouble);
  EXPECT_EQ(found.stored, Stored::ok);
  EXPECT_NEAR(found[Quantity::counts_per_metre].value, kCounts * pair.params().wheels.counts_per_metre, 2);
  EXPECT_NEAR(found[Quantity::counts_per_metre].sigma.raw(), 760, 20) << "2 mm and 1 mm of 3 m";
  EXPECT_NEAR(found[Quantity::track].value, pair.params().body.track.raw() / kCounts, 60);
  EXPECT_EQ(planning::Calibrator(storage).values(), static_cast<const Values&>(found));
  EXPECT_EQ(read_tape(3).trouble, Trouble::no_drive) << "a drive counts once";

  // With the new values, the same robot drives as far as it believes.
  const double again = drive();
  EXPECT_NEAR(again, 3, 0.01);
  const can::Calibrated wrong = read_tape(again / 2);
  EXPECT_EQ(wrong.trouble, Trouble::wrong_tape);
  EXPECT_EQ(static_cast<const Values&>(wrong), static_cast<const Values&>(found));
  drive();
  pair.begin(Order::start, {}, 300_mm);
  EXPECT_EQ(read_tape(3).trouble, Trouble::no_drive) << "another mission forgets the drive";
  pair.begin(Order::tape, {});
  pair.drive(5);
  pair.give(Order::cancel);
  EXPECT_EQ(read_tape(3).trouble, Trouble::no_drive) << "it did not end";
}

/// The power fails at every byte while it saves: at the next start there are the old values or the new ones.
TEST(CalibrationOnTheBus, APowerCutWhileItSavesLosesNoOldValue) {
  test::MemoryStorage storage;
  Values old;
  old[Quantity::wheel_ratio] = {1003000, millionths(90)};
  ASSERT_EQ(calibration::Store(storage).save(old), Stored::ok);
  const auto slots = storage.slots;
  Pair pair(kWrong, 6, storage);
  ASSERT_EQ(pair.calibrate(Order::spin, room(6)).stored, Stored::ok);
  const Values measured = pair.calibrator().values();
  int kept_old = 0, kept_new = 0;
  for (int power = 0; power <= calibration::kRecordBytes; ++power) {
    storage.slots = slots;
    storage.power = power;
    pair.calibrator().finish();
    storage.power = -1;
    const planning::Calibrator next(storage);
    ASSERT_EQ(next.stored(), Stored::ok) << power;
    const bool is_old = next.values() == old, is_new = next.values() == measured;
    EXPECT_NE(is_old, is_new) << power;
    kept_old += is_old ? 1 : 0;
    kept_new += is_new ? 1 : 0;
  }
  EXPECT_EQ(kept_new, 1) << "with enough power";
  EXPECT_EQ(kept_old, calibration::kRecordBytes);
}

TEST(CalibrationOnTheBus, AStorageThatFailsIsNamed) {
  test::MemoryStorage storage;
  storage.refuses = true;
  Pair pair(kWrong, 7, storage);
  can::Calibrated found = pair.calibrate(Order::spin, room(7));
  EXPECT_EQ(found.trouble, Trouble::none);
  EXPECT_EQ(found.stored, Stored::not_written);
  EXPECT_FALSE(found[Quantity::gyro_scale].known()) << "not kept, so it does not drive with it";
  storage.silent = true;
  found = pair.calibrate(Order::spin, room(7));
  EXPECT_EQ(found.stored, Stored::no_answer);
}

}  // namespace
}  // namespace whisker
