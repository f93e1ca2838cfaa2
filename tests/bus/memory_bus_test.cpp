#include "host/harness/bus/memory_bus.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/bus/frames.hpp"

namespace whisker::bus {
namespace {

using hal::CanFrame;
using hal::CanPort;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The arbitration bits in sending order; a dominant bit is 0.
std::vector<int> wire_bits(const CanFrame &f) {
  std::vector<int> bits;
  const auto put = [&bits](std::uint32_t value, int width) {
    for (int i = width - 1; i >= 0; --i) bits.push_back(static_cast<int>(value >> i & 1));
  };
  put(f.extended ? f.id >> 18 : f.id, 11);
  if (f.extended) {
    put(1, 1);  // SRR
    put(1, 1);  // IDE
    put(f.id & 0x3FFFF, 18);
    put(f.remote ? 1 : 0, 1);
  } else {
    put(f.remote ? 1 : 0, 1);
    put(0, 1);
  }
  return bits;
}

CanFrame any_frame() {
  CanFrame f{};
  f.extended = *rc::gen::arbitrary<bool>();
  f.remote = *rc::gen::arbitrary<bool>();
  // Few identifiers, so that frames often start with the same bits.
  f.id = *rc::gen::element(0U, 1U, 2U, 0x7FFU) << (f.extended ? 18 : 0);
  if (f.extended) f.id += *rc::gen::element(0U, 1U, 0x3FFFFU);
  return f;
}

RC_GTEST_PROP(MemoryBus, ArbitratesAsTheWireDoes, ()) {
  const CanFrame a = any_frame();
  const CanFrame b = any_frame();
  const auto bits_a = wire_bits(a);
  const auto bits_b = wire_bits(b);
  for (std::size_t i = 0; i < std::min(bits_a.size(), bits_b.size()); ++i) {
    if (bits_a[i] == bits_b[i]) continue;
    RC_ASSERT((arbitration(a) < arbitration(b)) == (bits_a[i] < bits_b[i]));
    return;
  }
  RC_ASSERT(arbitration(a) == arbitration(b));
}

TEST(MemoryBus, TakesFramesToAllButTheSender) {
  MemoryBus bus;
  MemoryPort &a = bus.attach(), &b = bus.attach(), &c = bus.attach();
  ASSERT_TRUE(a.send(frame(0x123), kLife_ms));
  EXPECT_THAT(taken(b), IsEmpty());
  a.poll(0);
  EXPECT_THAT(taken(a), IsEmpty());
  EXPECT_THAT(taken(b), ElementsAre(frame(0x123)));
  EXPECT_THAT(taken(c), ElementsAre(frame(0x123)));
  EXPECT_EQ(a.counts().sent, 1U);
  EXPECT_EQ(b.counts().received, 1U);
}

TEST(MemoryBus, SendsByPriorityAndEachNodeInItsOrder) {
  MemoryBus bus;
  MemoryPort &a = bus.attach(), &b = bus.attach(), &listener = bus.attach();
  for (const std::uint32_t id : {0x300U, 0x100U}) ASSERT_TRUE(a.send(frame(id), kLife_ms));
  for (const std::uint32_t id : {0x200U, 0x310U}) ASSERT_TRUE(b.send(frame(id), kLife_ms));
  listener.poll(0);
  EXPECT_THAT(taken(listener), ElementsAre(frame(0x200), frame(0x300), frame(0x100), frame(0x310)));
}

TEST(MemoryBus, CarriesNoMoreThanItsWire) {
  MemoryBus bus(2);
  MemoryPort &a = bus.attach(), &b = bus.attach();
  for (std::uint32_t id = 1; id <= 5; ++id) ASSERT_TRUE(a.send(frame(id), kLife_ms));
  a.poll(7);
  b.poll(7);
  EXPECT_EQ(taken(b).size(), 2U);
  b.poll(6);
  EXPECT_EQ(taken(b).size(), 0U);
  b.poll(8);
  EXPECT_EQ(taken(b).size(), 2U);
}

TEST(MemoryBus, OutbidsANodeForAsLongAsAnotherBabbles) {
  MemoryBus bus(2);
  MemoryPort &babbler = bus.attach(), &victim = bus.attach();
  std::uint32_t now_ms = UINT32_MAX - 10;
  victim.poll(now_ms);
  babbler.poll(now_ms);
  ASSERT_TRUE(victim.send(frame(0x100), kLife_ms));
  for (int i = 0; i < kLife_ms; ++i) {
    while (babbler.send(frame(0), CanPort::kLongestLife)) {
    }
    victim.poll(++now_ms);
    babbler.poll(now_ms);
    taken(victim);
  }
  EXPECT_EQ(victim.counts().sent, 0U);
  EXPECT_EQ(victim.counts().expired, 1U);
  EXPECT_EQ(victim.counts().outbid, 1U);
}

TEST(MemoryBus, LosesWhatNobodyTakes) {
  MemoryBus bus;
  MemoryPort &a = bus.attach(), &b = bus.attach();
  for (std::uint32_t id = 0; id < 20; ++id) {
    ASSERT_TRUE(a.send(frame(id), kLife_ms));
    a.poll(id);
  }
  EXPECT_EQ(b.counts().overrun, 20U - CanPort::kReceiveDepth);
  const auto frames = taken(b);
  ASSERT_EQ(frames.size(), CanPort::kReceiveDepth);
  EXPECT_EQ(frames.front(), frame(0));
}

TEST(MemoryBus, RefusesWhatIsNoFrameAndWhatHasNoRoom) {
  MemoryBus bus;
  MemoryPort &a = bus.attach();
  CanFrame nine = frame(1);
  nine.size = 9;
  CanFrame big = frame(0x800);
  big.extended = false;
  EXPECT_FALSE(a.send(nine, kLife_ms));
  EXPECT_FALSE(a.send(big, kLife_ms));
  EXPECT_FALSE(a.send(frame(0x20000000), kLife_ms));
  EXPECT_FALSE(a.send(frame(1), 0));
  EXPECT_FALSE(a.send(frame(1), CanPort::kLongestLife + 1));
  for (int i = 0; i < CanPort::kSendDepth; ++i) EXPECT_TRUE(a.send(frame(1), kLife_ms));
  EXPECT_FALSE(a.send(frame(1), kLife_ms));
  EXPECT_EQ(a.counts().refused, 6U);
}

}  // namespace
}  // namespace whisker::bus
