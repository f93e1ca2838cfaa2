#include "host/lab/bench/operator_client.hpp"

#include <gtest/gtest.h>

#include "host/harness/hil/planners.hpp"
#include "tests/can/rig.hpp"

namespace whisker::bench {
namespace {

constexpr std::uint8_t kSpeed = 3;
constexpr planning::Goal kNear{{1_m, 500_mm}, 100_mm}, kFar{{20_m, 5_m}, 100_mm};

/// Loses what the base says about time, while it is deaf.
class LosesSync final : public hal::CanPort {
 public:
  explicit LosesSync(hal::CanPort& port) : port_(port) {}
  bool send(const hal::CanFrame& frame, std::uint8_t lifetime_ms) noexcept override {
    return port_.send(frame, lifetime_ms);
  }
  bool receive(hal::CanFrame& out) noexcept override {
    while (port_.receive(out)) {
      can::MessageKind kind = can::MessageKind::e_stop;
      if (!deaf || !can::kind_of(out.id, kind) || kind != can::MessageKind::sync) return true;
    }
    return false;
  }
  void poll(std::uint32_t now_ms) noexcept override { port_.poll(now_ms); }
  void restart() noexcept override { port_.restart(); }
  hal::CanState state() const noexcept override { return port_.state(); }
  const hal::CanCounts& counts() const noexcept override { return port_.counts(); }

  bool deaf = false;

 private:
  hal::CanPort& port_;
};

/// Beside a robot whose base drives to a goal 30 m ahead; a wait of the client is a tick.
class ThirdParty : public ::testing::Test, public hil::Clock {
 protected:
  ThirdParty() {
    rig_.drive(20);
    rig_.give(can::Order::start);
    rig_.drive(300);
  }
  std::uint64_t now_us() override { return std::uint64_t{rig_.ticks()} * 10000; }
  void wait(std::uint64_t) override { rig_.drive(1); }
  void listen() {
    for (int i = 0; i < 40; ++i) {
      rig_.drive(1);
      hal::CanFrame frame{};
      port_.poll(now_ms());
      while (port_.receive(frame)) {
      }
    }
  }
  void connect() {
    listen();
    client_.connect();
  }
  planning::Outcome end() {
    for (int i = 0; i < 5000; ++i) {
      if (const auto told = client_.ended()) return told->outcome;
      wait_a_ms();
    }
    return planning::Outcome::running;
  }
  /// What NoAnswer says.
  template <class F>
  std::string trouble(const F& call) {
    try {
      call();
    } catch (const NoAnswer& e) {
      return e.what();
    }
    return "";
  }

  hil::HostPlanners planners_{kDefaultPlanner, nullptr};
  test::Rig rig_{test::open_ground(), {}, {}, 1, &planners_};
  Survey survey_;
  LosesSync heard_{rig_.wire().attach()};
  SurveyPort port_{heard_, survey_, *this};
  OperatorClient client_{port_, *this, survey_, 1, 100, {500, nullptr}};
};

TEST_F(ThirdParty, DrivesToAGoalAndToTheNext) {
  connect();
  client_.drive_to(kFar);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(client_.ended(), std::nullopt);
    wait_a_ms();
  }
  client_.drive_to(kNear);
  EXPECT_EQ(end(), planning::Outcome::reached);
  EXPECT_GT(client_.time_s(), 3);
  client_.drive_to({{0_m, 0_m}, 100_mm});
  EXPECT_EQ(client_.ended(), std::nullopt) << "not the end of the goal before";
  EXPECT_EQ(end(), planning::Outcome::reached);
  EXPECT_EQ(rig_.base().health().stops, 0U);
}

TEST_F(ThirdParty, ItsTimeBeginsWithTheFirstSyncAtTheLatest) {
  heard_.deaf = true;
  connect();
  client_.drive_to(kFar);
  heard_.deaf = false;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(client_.ended(), std::nullopt);
    wait_a_ms();
  }
  EXPECT_NEAR(client_.time_s(), 1, 0.1);
}

TEST_F(ThirdParty, WritesAfterACancelAndDrivesWithIt) {
  connect();
  const std::vector<Change> slower{{kSpeed, 300000, 200000}};
  const auto name_of = [](std::uint8_t) { return std::string("speed"); };
  EXPECT_EQ(write_all(client_, slower, name_of).status, can::ParamStatus::busy);
  client_.cancel();
  for (int i = 0; i < 60; ++i) wait_a_ms();
  EXPECT_TRUE(write_all(client_, slower, name_of).committed);
  EXPECT_EQ(client_.read(kSpeed), 200000U);
  client_.drive_to(kNear);
  EXPECT_EQ(end(), planning::Outcome::reached);
  EXPECT_EQ(rig_.controller().params().wheels.max_speed.raw(), 200000);
}

TEST_F(ThirdParty, AGoalRightAfterACancelWaitsUntilTheRobotStands) {
  connect();
  client_.cancel();
  client_.drive_to(kNear);
  EXPECT_EQ(end(), planning::Outcome::reached);
}

TEST_F(ThirdParty, SaysWhyARobotTakesNoOrder) {
  connect();
  rig_.give(can::Order::cancel);  // its wheels turn: it sends no set of the mission that the controller knows
  listen();
  EXPECT_EQ(
      trouble([&] { client_.drive_to(kNear); }),
      "the controller says refused to the goal (safe_stop: odometry_late): its base must give an order to "
      "start first");
  EXPECT_EQ(
      trouble([&] { client_.cancel(); }),
      "the controller says refused to the cancel (safe_stop: odometry_late): its base must give an order "
      "to start first");
}

TEST_F(ThirdParty, NoticesAnOrderOfTheBaseAndAnotherOperator) {
  connect();
  client_.drive_to(kFar);
  rig_.give(can::Order::resume);
  for (int i = 0; i < 45; ++i) client_.read(0);  // at rest, the base sends the order
  EXPECT_EQ(trouble([&] { client_.ended(); }), "the base has given another order");
  rig_.hand.say(can::ParamRequest{});
  EXPECT_EQ(trouble([&] { client_.read(0); }), "another operator commands robot 1");
}

TEST_F(ThirdParty, NoticesARobotThatFallsSilent) {
  connect();
  client_.drive_to(kFar);
  rig_.hand.send(can::encode(can::EStop{}, 0, 0));
  std::string words;
  for (int i = 0; i < 100 && words.empty(); ++i) {
    wait_a_ms();
    words = trouble([&] { client_.ended(); });
  }
  EXPECT_EQ(words, "the controller sends no NavStatus for 500 ms (e_stopped: e_stop)");
}

}  // namespace
}  // namespace whisker::bench
