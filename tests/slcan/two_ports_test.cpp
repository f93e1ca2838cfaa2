#include "hal/ports/two_ports.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace whisker::hal {
namespace {

/// A port with room for so many frames until it is polled.
class Fake final : public CanPort {
 public:
  bool send(const CanFrame& frame, uint8_t) noexcept override {
    if (waiting == kRoom) return false;
    ++waiting;
    sent.push_back(frame.id);
    return true;
  }
  bool receive(CanFrame& out) noexcept override {
    if (coming.empty()) return false;
    out = {coming.front(), false, false, 0, {}};
    coming.erase(coming.begin());
    return true;
  }
  void poll(uint32_t) noexcept override { waiting = 0; }
  void restart() noexcept override { ++restarts; }
  CanState state() const noexcept override { return now; }
  const CanCounts& counts() const noexcept override { return counts_; }

  static constexpr int kRoom = 2;
  CanState now = CanState::active;
  std::vector<uint32_t> sent, coming;
  int waiting = 0, restarts = 0;

 private:
  CanCounts counts_;
};

using Ids = std::vector<uint32_t>;

class TwoPortsTest : public testing::Test {
 protected:
  bool send(uint32_t id) { return both.send({id, false, false, 0, {}}, 10); }
  Fake first, second;
  TwoPorts<Fake> both{first, second};
};

TEST_F(TwoPortsTest, BothGetWhatIsSent) {
  for (uint32_t id = 1; id <= 5; ++id) EXPECT_TRUE(send(id)) << "a full one moves on";
  EXPECT_EQ(first.sent, (Ids{1, 2, 3, 4, 5}));
  EXPECT_EQ(second.sent, first.sent);
  EXPECT_EQ(both.counts().sent, 5U);
}

TEST_F(TwoPortsTest, OneThatIsNotOnTheBusHoldsNothingUp) {
  second.now = CanState::starting;
  EXPECT_TRUE(send(1));
  EXPECT_TRUE(second.sent.empty());
  EXPECT_EQ(both.state(), CanState::active);
  first.now = CanState::off;
  EXPECT_FALSE(send(2));
  EXPECT_EQ(both.counts().refused, 1U);
  EXPECT_EQ(both.state(), CanState::off);
  second.now = CanState::passive;
  EXPECT_TRUE(send(3));
  EXPECT_EQ(second.sent, Ids{3});
  EXPECT_EQ(both.state(), CanState::passive);
}

TEST_F(TwoPortsTest, WhatComesFromOneGoesToTheOther) {
  first.coming = {7, 8};
  second.coming = {9};
  Ids came;
  for (CanFrame frame{}; both.receive(frame);) came.push_back(frame.id);
  EXPECT_EQ(came, (Ids{7, 8, 9}));
  EXPECT_EQ(first.sent, Ids{9});
  EXPECT_EQ(second.sent, (Ids{7, 8}));
  EXPECT_EQ(both.counts().received, 3U);
}

TEST_F(TwoPortsTest, BothArePolledAndStartedAgain) {
  first.waiting = second.waiting = 1;
  both.poll(5);
  EXPECT_EQ(first.waiting + second.waiting, 0);
  both.restart();
  EXPECT_EQ(first.restarts + second.restarts, 2);
}

}  // namespace
}  // namespace whisker::hal
