#include <gtest/gtest.h>

#include "firmware/can/bus_guard.hpp"
#include "firmware/can/limits.hpp"

namespace whisker::can {
namespace {

/// A port whose state the test sets.
class StatePort final : public hal::CanPort {
 public:
  hal::CanState now = hal::CanState::active;
  int restarts = 0;

  void fail() {
    now = hal::CanState::bus_off;
    ++counts_.bus_offs;
  }
  bool send(const hal::CanFrame&, std::uint8_t) noexcept override { return false; }
  bool receive(hal::CanFrame&) noexcept override { return false; }
  void poll(std::uint32_t) noexcept override {}
  void restart() noexcept override { ++restarts; }
  hal::CanState state() const noexcept override { return now; }
  const hal::CanCounts& counts() const noexcept override { return counts_; }

 private:
  hal::CanCounts counts_;
};

struct Guarded {
  StatePort port;
  BusGuard guard;
  std::uint32_t now = 0;
  void pass(std::uint32_t ms) {
    for (std::uint32_t i = 0; i < ms; ++i) guard.watch(port, ++now);
  }
  void bus_off() {
    port.fail();
    pass(1);
  }
  void recover() {
    port.now = hal::CanState::active;
    pass(1);
  }
};

TEST(BusGuard, RestartsAHundredMillisecondsAfterBusOff) {
  Guarded g;
  g.pass(10);
  EXPECT_TRUE(g.guard.on_bus());
  g.bus_off();
  EXPECT_FALSE(g.guard.on_bus());
  EXPECT_EQ(g.guard.bus_offs(), 1U);
  g.pass(kRestartAfter_ms - 1);
  EXPECT_EQ(g.port.restarts, 0);
  g.pass(1);
  EXPECT_EQ(g.port.restarts, 1);
  g.port.now = hal::CanState::starting;
  g.pass(500);
  EXPECT_EQ(g.port.restarts, 1) << "it is on its way";
  EXPECT_FALSE(g.guard.on_bus());
  g.recover();
  EXPECT_TRUE(g.guard.on_bus());
}

TEST(BusGuard, PassiveStillTakesPart) {
  Guarded g;
  g.port.now = hal::CanState::passive;
  g.pass(1);
  EXPECT_TRUE(g.guard.on_bus());
}

TEST(BusGuard, FiveBusOffsInTenSecondsLatch) {
  Guarded g;
  for (int i = 0; i < 4; ++i) {
    g.bus_off();
    g.pass(kRestartAfter_ms);
    g.recover();
    EXPECT_TRUE(g.guard.on_bus());
  }
  EXPECT_EQ(g.port.restarts, 4);
  g.bus_off();
  EXPECT_TRUE(g.guard.latched());
  g.pass(20000);
  EXPECT_EQ(g.port.restarts, 4);
  g.recover();
  EXPECT_FALSE(g.guard.on_bus()) << "it stays away even where the port would not";
}

TEST(BusGuard, FiveBusOffsOverMoreTimeDoNot) {
  Guarded g;
  for (int i = 0; i < 20; ++i) {
    g.bus_off();
    g.pass(kRestartAfter_ms);
    g.recover();
    g.pass(kBusOffWindow_ms / 4);
    EXPECT_FALSE(g.guard.latched());
  }
  EXPECT_EQ(g.guard.bus_offs(), 20U);
}

TEST(BusGuard, APortThatIsOffIsStartedAgainAndAgain) {
  Guarded g;
  g.port.now = hal::CanState::off;
  g.pass(1000);
  EXPECT_GE(g.port.restarts, 9);
  EXPECT_FALSE(g.guard.latched());
}

}  // namespace
}  // namespace whisker::can
