#include "host/harness/bus/fault_port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>

#include "host/harness/bus/memory_bus.hpp"
#include "tests/bus/frames.hpp"

namespace whisker::bus {
namespace {

using hal::CanFrame;
using hal::CanPort;
using hal::CanState;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Frames = std::vector<CanFrame>;

/// A port with faults, and another node without on the same bus. A tick is 10 ms.
struct Rig {
  explicit Rig(Schedule schedule, std::uint64_t seed = 1, Repair repair = nullptr,
               std::uint32_t frames_per_ms = 100)
      : bus(frames_per_ms),
        inner(bus.attach()),
        peer(bus.attach()),
        port(inner, std::move(schedule), seed, std::move(repair)) {
    port.poll(now_ms);
  }
  /// Both nodes send, then one tick passes.
  void tick(const Frames& from_port, const Frames& from_peer = {}) {
    port.at_tick(++at);
    for (const CanFrame& f : from_port) port.send(f, kLife_ms);
    for (const CanFrame& f : from_peer) peer.send(f, kLife_ms);
    for (int i = 0; i < 10; ++i) {
      peer.poll(++now_ms);
      port.poll(now_ms);
    }
  }
  Frames at_peer() { return taken(peer); }
  Frames at_port() { return taken(port); }
  std::uint32_t tallied(FaultKind kind) const { return port.tally()[static_cast<std::size_t>(kind)]; }

  MemoryBus bus;
  MemoryPort& inner;
  MemoryPort& peer;
  FaultPort port;
  std::uint32_t now_ms = UINT32_MAX - 100;
  std::uint32_t at = 0;
};

Fault fault(FaultKind kind, std::uint32_t from, std::uint32_t to, Direction direction = Direction::both) {
  Fault f{kind};
  f.from_tick = from;
  f.to_tick = to;
  f.direction = direction;
  return f;
}

TEST(FaultPort, WithoutFaultsIsNotThere) {
  Rig rig({});
  rig.tick({frame(0x300), frame(0x100)}, {frame(0x200), frame(0x1FFFFFFF, 3)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(0x300), frame(0x100)));
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(0x200), frame(0x1FFFFFFF, 3)));
  EXPECT_EQ(rig.port.counts().sent, 2U);
  EXPECT_EQ(rig.port.counts().received, 2U);
  EXPECT_EQ(rig.port.tally(), Tally{});
}

TEST(FaultPort, LosesFramesInItsTicksOfItsDirectionAndIdentifiers) {
  Fault loss = fault(FaultKind::loss, 2, 4, Direction::out);
  loss.match_id = 0x120;
  loss.match_mask = 0x7F0;
  Rig rig({loss});
  std::vector<std::size_t> arrived;
  for (int i = 0; i < 5; ++i) {
    rig.tick({frame(0x12F), frame(0x130)}, {frame(0x12F)});
    arrived.push_back(rig.at_peer().size());
    EXPECT_EQ(rig.at_port().size(), 1U);
  }
  EXPECT_THAT(arrived, ElementsAre(2, 1, 1, 2, 2));
  EXPECT_EQ(rig.tallied(FaultKind::loss), 2U);
  EXPECT_EQ(rig.port.counts().sent, 10U);
}

TEST(FaultPort, LosesBursts) {
  Fault burst = fault(FaultKind::loss, 2, 3);
  burst.length = 2;
  Rig rig({burst});
  rig.tick({});
  rig.tick({frame(1), frame(2), frame(3), frame(4)});
  EXPECT_THAT(rig.at_peer(), IsEmpty());
  Fault rare = fault(FaultKind::loss, 0, UINT32_MAX, Direction::out);
  rare.chance = 0.01;
  rare.length = 5;
  Rig other({rare});
  std::size_t run = 0;
  for (int i = 0; i < 2000; ++i) {
    other.tick({frame(1)});
    if (other.at_peer().empty()) {
      ++run;
    } else {
      EXPECT_EQ(run % 5, 0U);
      run = 0;
    }
  }
  EXPECT_GT(other.tallied(FaultKind::loss), 50U);
}

TEST(FaultPort, DelaysFramesByTicks) {
  Fault delay = fault(FaultKind::delay, 1, 2);
  delay.ticks = 2;
  Rig rig({delay});
  rig.tick({frame(1)}, {frame(2)});
  rig.tick({frame(3)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(3)));
  EXPECT_THAT(rig.at_port(), IsEmpty());
  rig.tick({});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(1)));
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(2)));
}

TEST(FaultPort, JitterLetsFramesOvertakeAndLosesNone) {
  Fault jitter = fault(FaultKind::delay, 0, UINT32_MAX, Direction::in);
  jitter.ticks = 0;
  jitter.jitter = 3;
  Rig rig({jitter});
  Frames got;
  for (std::uint32_t i = 0; i < 200; ++i) {
    rig.tick({}, {frame(i)});
    for (const CanFrame& f : rig.at_port()) got.push_back(f);
  }
  for (int i = 0; i < 4; ++i) rig.tick({});
  for (const CanFrame& f : rig.at_port()) got.push_back(f);
  ASSERT_EQ(got.size(), 200U);
  const auto by_id = [](const CanFrame& a, const CanFrame& b) { return a.id < b.id; };
  EXPECT_FALSE(std::is_sorted(got.begin(), got.end(), by_id));
  std::sort(got.begin(), got.end(), by_id);
  for (std::uint32_t i = 0; i < 200; ++i) EXPECT_EQ(got[i].id, i);
}

TEST(FaultPort, DoublesAndReorders) {
  Rig rig({fault(FaultKind::duplicate, 1, 2), fault(FaultKind::reorder, 2, 3)});
  rig.tick({frame(1)}, {frame(2)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(1), frame(1)));
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(2), frame(2)));
  rig.tick({frame(1), frame(2), frame(3)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(2), frame(1)));
  rig.tick({frame(4)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(4), frame(3)));
}

int bits_apart(const CanFrame& a, const CanFrame& b) {
  int bits = 0;
  for (int i = 0; i < 8; ++i) bits += __builtin_popcount(static_cast<unsigned>(a.data[i] ^ b.data[i]));
  return bits;
}

TEST(FaultPort, CorruptsOneBitAndForgesTheCheckValue) {
  const Repair repair = [](CanFrame& f) { f.data[0] = 0xEE; };
  Rig rig({fault(FaultKind::corrupt, 1, 2), fault(FaultKind::forge, 2, 3)}, 1, repair);
  rig.tick({frame(1, 3), frame(2, 0), remote(3, 8)});
  const Frames bad = rig.at_peer();
  ASSERT_EQ(bad.size(), 3U);
  EXPECT_EQ(bits_apart(bad[0], frame(1, 3)), 1);
  EXPECT_EQ(bad[1], frame(2, 0));
  EXPECT_EQ(bad[2], remote(3, 8));
  EXPECT_EQ(rig.tallied(FaultKind::corrupt), 1U);
  rig.tick({}, {frame(4, 8, 0x10)});
  const Frames forged = rig.at_port();
  ASSERT_EQ(forged.size(), 1U);
  EXPECT_EQ(forged[0].data[0], 0xEE);
}

TEST(FaultPort, ChangesWhatAFrameIs) {
  Fault other = fault(FaultKind::masquerade, 4, 5);
  other.id = 0x222;
  Rig rig({fault(FaultKind::wrong_size, 1, 2), fault(FaultKind::make_remote, 2, 3),
           fault(FaultKind::make_extended, 3, 4), other});
  for (int i = 0; i < 4; ++i) rig.tick({frame(0x111, 4)});
  const Frames got = rig.at_peer();
  ASSERT_EQ(got.size(), 4U);
  EXPECT_NE(got[0].size, 4);
  EXPECT_LE(got[0].size, 8);
  EXPECT_EQ(got[1], remote(0x111, 4));
  EXPECT_EQ(got[2], (CanFrame{0x111, true, false, 4, {0, 1, 2, 3}}));
  EXPECT_EQ(got[3], frame(0x222, 4));
}

TEST(FaultPort, FreezesTheDataOfEachIdentifier) {
  Rig rig({fault(FaultKind::freeze, 2, 4)});
  for (std::uint8_t i = 0; i < 4; ++i)
    rig.tick({frame(1, 1, i), frame(2, 1, static_cast<std::uint8_t>(10 + i))});
  std::vector<int> first_bytes;
  for (const CanFrame& f : rig.at_peer()) first_bytes.push_back(f.data[0]);
  EXPECT_THAT(first_bytes, ElementsAre(0, 10, 1, 11, 1, 11, 3, 13));
  EXPECT_EQ(rig.tallied(FaultKind::freeze), 2U);
}

TEST(FaultPort, LetsAnotherBabble) {
  Fault babble = fault(FaultKind::babble, 1, 4, Direction::in);
  babble.length = 3;
  babble.id = 0x100;
  Rig rig({babble});
  rig.tick({frame(0x0FF), frame(0x101)}, {frame(0x55)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(0x0FF)));
  EXPECT_EQ(rig.at_port().size(), 4U);
  rig.tick({});
  rig.tick({});
  EXPECT_THAT(rig.at_peer(), IsEmpty());
  EXPECT_EQ(rig.port.counts().expired, 1U);
  EXPECT_EQ(rig.port.counts().outbid, 1U);
  rig.at_port();
  rig.tick({frame(0x102)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(0x102)));
  EXPECT_THAT(rig.at_port(), IsEmpty());
}

TEST(FaultPort, BabblesItself) {
  Fault babble = fault(FaultKind::babble, 1, 2, Direction::out);
  babble.length = 3;
  Rig rig({babble});
  rig.tick({frame(0x101)});
  EXPECT_EQ(rig.at_peer().size(), 4U);
  EXPECT_THAT(rig.at_port(), IsEmpty());
}

TEST(FaultPort, GoesBusOffUntilItIsRestartedAfterTheFault) {
  Rig rig({fault(FaultKind::bus_off, 2, 4)});
  rig.tick({frame(1)});
  rig.tick({}, {frame(2)});
  EXPECT_EQ(rig.port.state(), CanState::bus_off);
  EXPECT_FALSE(rig.port.send(frame(3), kLife_ms));
  rig.port.restart();
  EXPECT_EQ(rig.port.state(), CanState::starting);
  rig.tick({});
  EXPECT_EQ(rig.port.state(), CanState::bus_off);
  EXPECT_EQ(rig.port.counts().bus_offs, 2U);
  rig.tick({}, {frame(2)});
  EXPECT_EQ(rig.port.state(), CanState::bus_off);
  rig.port.restart();
  rig.tick({frame(4)}, {frame(5)});
  EXPECT_EQ(rig.port.state(), CanState::active);
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(5)));
  rig.tick({frame(6)});
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(1), frame(6)));
  EXPECT_EQ(rig.tallied(FaultKind::bus_off), 2U);
}

TEST(FaultPort, IsPassiveButTakesPart) {
  Rig rig({fault(FaultKind::passive, 1, 2)});
  rig.tick({frame(1)});
  EXPECT_EQ(rig.port.state(), CanState::passive);
  EXPECT_THAT(rig.at_peer(), ElementsAre(frame(1)));
  rig.tick({});
  EXPECT_EQ(rig.port.state(), CanState::active);
}

TEST(FaultPort, GoesDownAndComesBack) {
  Rig rig({fault(FaultKind::down, 2, 3)});
  rig.tick({});
  rig.tick({}, {frame(1)});
  EXPECT_EQ(rig.port.state(), CanState::starting);
  EXPECT_FALSE(rig.port.send(frame(2), kLife_ms));
  rig.tick({}, {frame(3)});
  EXPECT_EQ(rig.port.state(), CanState::active);
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(3)));
  EXPECT_TRUE(rig.port.send(frame(4), kLife_ms));
}

TEST(FaultPort, HearsNothingWhileItIsDownNotEvenLater) {
  Fault delay = fault(FaultKind::delay, 2, 3, Direction::in);
  delay.ticks = 2;
  Rig rig({fault(FaultKind::down, 2, 3), delay});
  rig.tick({});
  rig.tick({}, {frame(1)});
  for (int i = 0; i < 4; ++i) rig.tick({});
  EXPECT_THAT(rig.at_port(), IsEmpty());
}

TEST(FaultPort, CountsWhatIsLateAndFindsNoRoomThen) {
  Rig rig({fault(FaultKind::delay, 1, 2, Direction::out)});
  rig.tick(Frames(12, frame(1)));
  rig.tick(Frames(12, frame(2)));
  EXPECT_EQ(rig.at_peer().size(), CanPort::kReceiveDepth);
  EXPECT_EQ(rig.port.counts().sent, 24U);
  EXPECT_EQ(rig.port.counts().expired, 24U - CanPort::kSendDepth);
}

TEST(FaultPort, DropsWhatADriverHasNoRoomForUntilItIsTooOld) {
  Rig rig({fault(FaultKind::full, 1, 4)});
  rig.tick(Frames(20, frame(1)));
  rig.tick({});
  rig.tick({});
  EXPECT_THAT(rig.at_peer(), IsEmpty());
  EXPECT_EQ(rig.port.counts().refused, 4U);
  EXPECT_EQ(rig.port.counts().expired, 16U);
  EXPECT_EQ(rig.tallied(FaultKind::full), 16U);
  EXPECT_EQ(rig.port.state(), CanState::active);
}

TEST(FaultPort, OverrunsItsReceiver) {
  Fault overrun = fault(FaultKind::overrun, 1, 2);
  overrun.length = 2;
  Rig rig({overrun});
  rig.tick({}, {frame(1), frame(2), frame(3), frame(4)});
  EXPECT_THAT(rig.at_port(), ElementsAre(frame(1), frame(2)));
  EXPECT_EQ(rig.port.counts().overrun, 2U);
  rig.tick({}, {frame(1), frame(2), frame(3), frame(4)});
  EXPECT_EQ(rig.at_port().size(), 4U);
}

Schedule any_schedule() {
  Schedule schedule;
  const auto lines = *rc::gen::inRange(0, 6);
  for (int i = 0; i < lines; ++i) {
    Fault f{static_cast<FaultKind>(*rc::gen::inRange(0, static_cast<int>(kFaultKinds)))};
    f.from_tick = *rc::gen::inRange(0U, 40U);
    f.to_tick = f.from_tick + *rc::gen::inRange(0U, 40U);
    f.direction = *rc::gen::element(Direction::out, Direction::in, Direction::both);
    f.chance = *rc::gen::element(0.05, 0.5, 1.0);
    f.length = *rc::gen::inRange(1U, 5U);
    f.ticks = *rc::gen::inRange(0U, 4U);
    f.jitter = *rc::gen::inRange(0U, 4U);
    f.id = *rc::gen::inRange(0U, 0x300U);
    schedule.push_back(f);
  }
  return schedule;
}

/// All observable results of a run with this schedule.
struct Shown {
  Frames frames;
  std::vector<CanState> states;
  Tally tally;
  bool operator==(const Shown& o) const {
    return frames == o.frames && states == o.states && tally == o.tally;
  }
};

Shown run(const Schedule& schedule, std::uint64_t seed) {
  Rig rig(schedule, seed);
  Shown shown;
  for (std::uint8_t i = 0; i < 100; ++i) {
    if (rig.port.state() == CanState::bus_off && i % 4 == 0) rig.port.restart();
    rig.tick({frame(0x100, 8, i), frame(0x200, 8, i)}, {frame(0x110, 8, i)});
    for (const CanFrame& f : rig.at_peer()) shown.frames.push_back(f);
    for (const CanFrame& f : rig.at_port()) shown.frames.push_back(f);
    shown.states.push_back(rig.port.state());
  }
  shown.tally = rig.port.tally();
  return shown;
}

RC_GTEST_PROP(FaultPort, GivesTheSameFaultsAgain, ()) {
  const Schedule schedule = any_schedule();
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  RC_ASSERT(run(schedule, seed) == run(schedule, seed));
}

RC_GTEST_PROP(FaultPort, AccountsForEveryFrameThatItsOwnerSends, ()) {
  const Schedule schedule = any_schedule();
  Rig rig(schedule, 7);
  std::uint32_t offered = 0;
  for (std::uint8_t i = 0; i < 60; ++i) {
    if (rig.port.state() == CanState::bus_off) rig.port.restart();
    rig.tick({frame(0x100, 8, i), frame(0x200, 8, i)});
    offered += 2;
    rig.at_peer();
    rig.at_port();
  }
  for (int i = 0; i < 10; ++i) rig.tick({});
  const hal::CanCounts& counts = rig.port.counts();
  RC_ASSERT(counts.sent + counts.refused + counts.expired == offered);
}

RC_GTEST_PROP(FaultPort, LosesAndDoublesAsManyAsItSays, ()) {
  Schedule schedule;
  for (const Fault& f : any_schedule()) {
    if (f.kind == FaultKind::loss || f.kind == FaultKind::duplicate || f.kind == FaultKind::delay)
      schedule.push_back(f);
  }
  Rig rig(schedule, 7);
  std::uint32_t arrived = 0;
  for (std::uint8_t i = 0; i < 90; ++i) {
    rig.tick(i < 60 ? Frames{frame(0x100, 8, i), frame(0x200, 8, i)} : Frames{});
    arrived += static_cast<std::uint32_t>(rig.at_peer().size());
  }
  // Loss must come last: a frame that was duplicated before may be lost together with its copy.
  const bool loses_last = std::is_partitioned(schedule.begin(), schedule.end(),
                                              [](const Fault& f) { return f.kind == FaultKind::loss; });
  RC_PRE(loses_last);
  RC_ASSERT(arrived == 120 - rig.tallied(FaultKind::loss) + rig.tallied(FaultKind::duplicate));
}

}  // namespace
}  // namespace whisker::bus
