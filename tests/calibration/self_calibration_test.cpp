// A robot with a button and a storage, on the simulated board.
#include "firmware/apps/calibration/self_calibration.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "firmware/planning/default_planner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "host/lab/calibration/drive_rig.hpp"
#include "tests/calibration/memory_storage.hpp"

namespace whisker {
namespace {

using calibration::Quantity;
using calibration::Stored;
using hal::Press;
using planning::Trouble;
using Phase = SelfCalibration::Phase;

struct FakeButton final : hal::Button {
  Press take() noexcept override { return std::exchange(press, Press::none); }
  Press press = Press::none;
};

constexpr calibration::WheelErrors kWrong{1.02, 0.985, 1, 0.98};

Scenario with_gyro() {
  Scenario s;
  apply_robot_file(s, WHISKER_SOURCE_DIR "/host/robots/gyro.toml");
  return s;
}

Scenario room() { return calibration::scene(calibration::Scene::room, with_gyro().robot, 1); }

/// One start of a board in a world.
class Station {
 public:
  Station(Scenario world, hal::Storage& storage) : calibrator(storage) {
    world.robot = params_;
    world_ = std::make_unique<SimWorld>(world);
    sim::RobotSpec spec = robot_spec(world);
    spec.wheel_ratio *= kWrong.wheel_ratio;
    spec.track *= kWrong.track;
    spec.gyro_range *= kWrong.gyro_scale;
    plant_ = std::make_unique<sim::Plant>(world_->view(), spec, sim::NoiseSpec{}, 1, sim::Pose{});
    board_ = std::make_unique<hal::SimBoard>(*plant_);
    calibrator.apply(usual_params_);
    planner_ = std::make_unique<planning::DefaultPlanner>(usual_params_, fuzzy::kDefaultTable);
    usual =
        std::make_unique<Robot>(*board_, *board_, planner_->planner, usual_params_, nullptr, board_.get());
    self =
        std::make_unique<SelfCalibration>(*usual, calibrator, params_, button,
                                          SelfCalibration::Devices{*board_, *board_, nullptr, board_.get()});
    usual->place({});
  }
  void pass(double seconds) {
    for (int i = 0; i < seconds * 100; ++i) tick();
  }
  void press(Press press) {
    button.press = press;
    tick();
  }
  /// Until the calibration ends, 120 s at most.
  Phase drive() {
    for (int i = 0; i < 12000; ++i) {
      tick();
      if (self->phase() == Phase::ended || self->phase() == Phase::cancelled) break;
    }
    return self->phase();
  }
  Phase calibrate(Press kind) {
    press(kind);
    return drive();
  }
  bool stands() const { return plant_->v_left() == 0 && plant_->v_right() == 0; }
  const sim::Plant& plant() const { return *plant_; }
  std::string word() const { return self->word() == nullptr ? "" : self->word(); }

  planning::Calibrator calibrator;
  FakeButton button;
  std::uint32_t now = 0;
  std::unique_ptr<Robot> usual;
  std::unique_ptr<SelfCalibration> self;

 private:
  void tick() {
    self->tick(Time::from_raw(now));
    now += 10;
    EXPECT_FALSE(plant_->in_contact());
    plant_->advance();
  }

  const Params params_ = with_gyro().robot;
  Params usual_params_ = params_;
  std::unique_ptr<SimWorld> world_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<hal::SimBoard> board_;
  std::unique_ptr<planning::DefaultPlanner> planner_;
};

double off(const calibration::Values& values, Quantity q) {
  return values[q].value / calibration::true_value(with_gyro().robot, kWrong, q) - 1;
}

TEST(SelfCalibration, AHeldPressSpinsABriefOneDrivesAndTheNextStartHasBoth) {
  test::MemoryStorage storage;
  {
    Station station(room(), storage);
    EXPECT_EQ(station.self->phase(), Phase::none);
    EXPECT_EQ(station.word(), "");
    ASSERT_EQ(station.calibrate(Press::held), Phase::ended);
    EXPECT_EQ(station.word(), "ok");
    station.pass(1);
    EXPECT_TRUE(station.stands());
    EXPECT_EQ(station.self->status().health.fault, Fault::none);
  }
  Station station({}, storage);
  EXPECT_LT(std::abs(off(station.calibrator.values(), Quantity::gyro_scale)), 1e-3);
  ASSERT_EQ(station.calibrate(Press::brief), Phase::ended);
  EXPECT_EQ(station.word(), "ok");
  EXPECT_NEAR(station.plant().pose().at.x, 0, 0.1) << "there and back";
  const planning::Calibrator next(storage);
  for (const Quantity q : {Quantity::gyro_scale, Quantity::wheel_ratio, Quantity::track}) {
    EXPECT_LT(std::abs(off(next.values(), q)), 1e-3) << name(q);
  }
}

TEST(SelfCalibration, APressEndsTheUsualMissionAndGivesThePersonTimeToStepBack) {
  test::MemoryStorage storage;
  Station station({}, storage);
  station.usual->set_goal({{2_m, 0_m}, 100_mm});
  station.pass(5);
  ASSERT_FALSE(station.stands());
  station.press(Press::brief);
  EXPECT_EQ(station.word(), "starts");
  station.pass(2);
  EXPECT_TRUE(station.stands());
  const double x = station.plant().pose().at.x;
  station.pass(0.95);
  EXPECT_EQ(station.self->phase(), Phase::starts);
  station.pass(0.1);
  EXPECT_EQ(station.self->phase(), Phase::measures);
  EXPECT_EQ(station.word(), "measures");
  EXPECT_EQ(station.plant().pose().at.x, x);
}

TEST(SelfCalibration, AnotherPressEndsItWithoutAValueAndOneMoreStartsAgain) {
  test::MemoryStorage storage;
  const auto slots = storage.slots;
  Station station(room(), storage);
  station.press(Press::held);
  station.pass(1);
  station.press(Press::held);
  EXPECT_EQ(station.word(), "cancelled") << "before it drives";
  station.pass(10);
  EXPECT_TRUE(station.stands());

  station.press(Press::held);
  station.pass(10);
  ASSERT_FALSE(station.stands());
  station.press(Press::brief);
  EXPECT_EQ(station.word(), "cancelled");
  station.pass(60);
  EXPECT_TRUE(station.stands());
  EXPECT_EQ(storage.slots, slots);
  EXPECT_EQ(station.calibrate(Press::held), Phase::ended);
  EXPECT_EQ(station.word(), "ok");
}

TEST(SelfCalibration, WithoutAResultTheReasonIsTheWordAndNothingIsSaved) {
  test::MemoryStorage storage;
  const auto slots = storage.slots;
  Station nothing({}, storage);
  EXPECT_EQ(nothing.calibrate(Press::held), Phase::ended);
  EXPECT_EQ(nothing.word(), "nothing_in_range");
  Scenario wall;
  wall.walls.push_back({{1, -3}, {1, 3}});
  Station blocked(wall, storage);
  EXPECT_EQ(blocked.calibrate(Press::brief), Phase::ended);
  EXPECT_EQ(blocked.word(), "blocked");
  EXPECT_EQ(storage.slots, slots);
}

TEST(SelfCalibration, AFaultCancelsItAndTheNextPressStartsAnew) {
  test::MemoryStorage storage;
  Station station(room(), storage);
  station.press(Press::held);
  station.pass(8);
  ASSERT_EQ(station.self->phase(), Phase::measures);
  station.now += 5000;  // no ticks for so long
  station.pass(3);
  EXPECT_EQ(station.word(), "cancelled");
  EXPECT_NE(station.self->status().health.fault, Fault::none);
  EXPECT_TRUE(station.stands());
  EXPECT_EQ(station.calibrate(Press::held), Phase::ended);
  EXPECT_EQ(station.word(), "ok");
}

TEST(SelfCalibration, AStorageThatFailsIsTheWord) {
  test::MemoryStorage storage;
  storage.refuses = true;
  Station station(room(), storage);
  EXPECT_EQ(station.calibrate(Press::held), Phase::ended);
  EXPECT_EQ(station.word(), "not_written");
}

}  // namespace
}  // namespace whisker
