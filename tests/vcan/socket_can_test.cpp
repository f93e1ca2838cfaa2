#include "hal/ports/socketcan/socket_can.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/bus/frames.hpp"
#include "tests/vcan/tools.hpp"

namespace whisker::hal::socketcan {
namespace {

using bus::frame;
using bus::kLife_ms;
using bus::remote;
using bus::taken;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using vcan::Running;
using vcan::shell;

/// Another node on the bus, without a port.
class RawSocket {
 public:
  RawSocket() : socket_(socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(if_nametoindex("vtest0"));
    if (bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw SocketCanError("no vtest0");
  }
  ~RawSocket() { close(socket_); }
  void write(std::uint32_t id) {
    can_frame f{};
    f.can_id = id;
    f.len = 8;
    ASSERT_EQ(::write(socket_, &f, sizeof f), static_cast<ssize_t>(sizeof f));
  }

 private:
  int socket_;
};

class SocketCanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    shell("ip link add dev vtest0 type vcan && ip link set vtest0 up");
    port.poll(now);
    ASSERT_EQ(port.state(), CanState::active) << port.waits_for();
  }
  // Also removes the test's changes to the interface.
  void TearDown() override { shell("ip link del vtest0"); }
  /// Advances the port's clock in real time.
  template <class Condition>
  bool soon(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < end) {
      port.poll(++now);
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  std::vector<CanFrame> next(std::size_t count) {
    std::vector<CanFrame> frames;
    soon([&] {
      for (const CanFrame& f : taken(port)) frames.push_back(f);
      return frames.size() >= count;
    });
    return frames;
  }
  bool comes_to(CanState state) {
    return soon([&] { return port.state() == state; });
  }
  std::uint32_t now = UINT32_MAX - 30;
  SocketCan port{"vtest0"};
};

TEST_F(SocketCanTest, ReceivesWhatCansendSends) {
  shell(
      "cansend vtest0 123#1122334455667788 && cansend vtest0 7FF# && cansend vtest0 12345678#AA && cansend "
      "vtest0 321#R4");
  const CanFrame full{0x123, false, false, 8, {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}};
  const CanFrame extended{0x12345678, true, false, 1, {0xAA}};
  EXPECT_THAT(next(4), ElementsAre(full, frame(0x7FF, 0), extended, remote(0x321, 4)));
  EXPECT_EQ(port.counts().received, 4U);
}

TEST_F(SocketCanTest, SendsWhatCandumpShows) {
  const std::string list = "grep -c 'vtest0.*raw' /proc/self/net/can/rcvlist_all || true";
  const std::string before = shell(list);
  Running candump("timeout 20 candump -L -n 4 vtest0");
  ASSERT_TRUE(soon([&] { return shell(list) != before; }));
  const CanFrame frames[] = {frame(0x700, 8, 0x10), frame(0x001, 0), frame(0x1FFFFFFF, 3, 0xF0),
                             remote(0x123, 2)};
  for (const CanFrame& f : frames) ASSERT_TRUE(port.send(f, kLife_ms));
  port.poll(++now);
  const std::string log = candump.wait();
  EXPECT_THAT(log, ::testing::ContainsRegex("^\\([0-9.]+\\) vtest0 700#1011121314151617\n"
                                            "\\([0-9.]+\\) vtest0 001#\n"
                                            "\\([0-9.]+\\) vtest0 1FFFFFFF#F0F1F2\n"
                                            "\\([0-9.]+\\) vtest0 123#R2\n$"));
  EXPECT_EQ(port.counts().sent, 4U);
  EXPECT_THAT(taken(port), IsEmpty()) << "its own";
}

TEST_F(SocketCanTest, TwoPortsSeeEachOther) {
  SocketCan other("vtest0");
  other.poll(now);
  for (std::uint32_t id = 0; id < CanPort::kSendDepth; ++id) ASSERT_TRUE(other.send(frame(id), kLife_ms));
  EXPECT_FALSE(other.send(frame(1), kLife_ms));
  other.poll(now);
  const auto frames = next(CanPort::kSendDepth);
  ASSERT_EQ(frames.size(), CanPort::kSendDepth);
  for (std::uint32_t id = 0; id < CanPort::kSendDepth; ++id) EXPECT_EQ(frames[id], frame(id));
}

TEST_F(SocketCanTest, FiltersByIdentifierFormatAndKind) {
  SocketCan picky("vtest0", {{0x120, 0x7F0, false}, {0x1234500, 0x1FFFFF00, true}});
  picky.poll(now);
  shell(
      "cansend vtest0 12F#01 && cansend vtest0 130#02 && cansend vtest0 121#R && cansend vtest0 00000125#03 "
      "&& "
      "cansend vtest0 01234567#04 && cansend vtest0 120#05");
  std::vector<CanFrame> frames;
  soon([&] {
    picky.poll(now);
    for (const CanFrame& f : taken(picky)) frames.push_back(f);
    return frames.size() >= 3;
  });
  EXPECT_THAT(frames, ElementsAre(frame(0x12F, 1, 1), frame(0x1234567, 1, 4), frame(0x120, 1, 5)));
}

TEST_F(SocketCanTest, ComesBackWithTheInterface) {
  ASSERT_TRUE(port.send(frame(1), kLife_ms));
  shell("ip link set vtest0 down");
  EXPECT_TRUE(comes_to(CanState::starting));
  EXPECT_EQ(port.waits_for(), "vtest0 is down");
  EXPECT_FALSE(port.send(frame(2), kLife_ms));
  EXPECT_EQ(port.counts().sent + port.counts().expired, 1U);
  shell("ip link set vtest0 up");
  EXPECT_TRUE(comes_to(CanState::active));
  EXPECT_EQ(port.waits_for(), "");
  shell("cansend vtest0 123#");
  EXPECT_EQ(next(1).size(), 1U);
}

TEST_F(SocketCanTest, SeesAnInterfaceDownOnSending) {
  shell("ip link set vtest0 down && ip link set vtest0 up");
  EXPECT_TRUE(comes_to(CanState::active));
  ASSERT_TRUE(port.send(frame(1), kLife_ms));
  port.poll(++now);
  EXPECT_EQ(port.counts().sent, 1U);
}

TEST_F(SocketCanTest, FindsAnInterfaceThatWasMadeAnew) {
  shell("ip link del vtest0");
  EXPECT_TRUE(comes_to(CanState::starting));
  EXPECT_TRUE(soon([&] { return port.waits_for() == "vtest0 does not exist"; }));
  shell("ip link add dev vtest0 type vcan");
  EXPECT_TRUE(soon([&] { return port.waits_for() == "vtest0 is down"; }));
  shell("ip link set vtest0 up");
  EXPECT_TRUE(comes_to(CanState::active));
  shell("cansend vtest0 123#");
  EXPECT_EQ(next(1).size(), 1U);
  ASSERT_TRUE(port.send(frame(1), kLife_ms));
  port.poll(++now);
  EXPECT_EQ(port.counts().sent, 1U);
}

TEST_F(SocketCanTest, NoticesThatItWasMadeAnewBetweenTwoPolls) {
  shell("ip link del vtest0 && ip link add dev vtest0 type vcan && ip link set vtest0 up");
  port.poll(++now);
  ASSERT_TRUE(comes_to(CanState::active));
  shell("cansend vtest0 123#");
  EXPECT_EQ(next(1).size(), 1U);
}

TEST_F(SocketCanTest, ForgetsWhatWasOnTheBusBeforeItWentDown) {
  shell("cansend vtest0 111# && ip link set vtest0 down && ip link set vtest0 up");
  ASSERT_TRUE(comes_to(CanState::active));
  shell("cansend vtest0 222#");
  EXPECT_THAT(next(1), ElementsAre(frame(0x222, 0)));
}

// Error frames of a controller's driver: a raw socket receives them as ordinary frames.
TEST_F(SocketCanTest, IsSilentAfterBusOffUntilItIsRestarted) {
  ASSERT_TRUE(port.send(frame(1), kLife_ms));
  shell("cansend vtest0 20000040#0000000000000000");
  ASSERT_TRUE(comes_to(CanState::bus_off));
  EXPECT_EQ(port.counts().bus_offs, 1U);
  EXPECT_EQ(port.waits_for(), "vtest0 is bus-off");
  EXPECT_FALSE(port.send(frame(2), kLife_ms));
  shell("cansend vtest0 123#");
  for (int i = 0; i < 200; ++i) port.poll(++now);
  EXPECT_EQ(port.state(), CanState::bus_off);
  port.restart();
  EXPECT_EQ(port.state(), CanState::starting);
  EXPECT_TRUE(comes_to(CanState::active));
  EXPECT_THAT(taken(port), IsEmpty());
  shell("cansend vtest0 20000040#0000000000000000");
  ASSERT_TRUE(comes_to(CanState::bus_off));
  EXPECT_EQ(port.counts().bus_offs, 2U);
}

TEST_F(SocketCanTest, KnowsWhenItIsPassive) {
  shell("cansend vtest0 20000004#0020000000000000");
  EXPECT_TRUE(comes_to(CanState::passive));
  EXPECT_TRUE(port.send(frame(1), kLife_ms));
  shell("cansend vtest0 20000004#0001000000000000");
  EXPECT_TRUE(soon([&] { return port.counts().overrun == 1; }));
  EXPECT_EQ(port.state(), CanState::passive);
  shell("cansend vtest0 20000004#0040000000000000");
  EXPECT_TRUE(comes_to(CanState::active));
  shell("cansend vtest0 20000004#0010000000000000 && cansend vtest0 20000004#0008000000000000");
  EXPECT_TRUE(comes_to(CanState::active));
  EXPECT_THAT(taken(port), IsEmpty());
}

TEST_F(SocketCanTest, CountsWhatTheKernelDropped) {
  constexpr std::uint32_t kFlood = 3000;
  RawSocket other;
  for (std::uint32_t i = 0; i < kFlood; ++i) other.write(0x100);
  std::uint32_t got = 0;
  // The kernel reports its count with the next frame.
  EXPECT_TRUE(soon([&] {
    got += static_cast<std::uint32_t>(taken(port).size());
    other.write(0x101);
    return port.counts().overrun > 0;
  }));
  EXPECT_GT(got, CanPort::kReceiveDepth);
  EXPECT_LT(port.counts().overrun, kFlood);
  EXPECT_GE(port.counts().overrun + got, kFlood - CanPort::kReceiveDepth);
}

/// 16 bytes per frame: one frame every 128 ms, and a queue for two more.
constexpr const char* kSlow = "tc qdisc replace dev vtest0 root tbf rate 1kbit burst 16 limit 32";

TEST_F(SocketCanTest, DropsWhatTheKernelHasNoRoomForUntilItIsTooOld) {
  shell(kSlow);
  for (std::uint32_t i = 0; i < CanPort::kSendDepth; ++i) ASSERT_TRUE(port.send(frame(i), kLife_ms));
  port.poll(++now);
  const std::uint32_t sent = port.counts().sent;
  EXPECT_GE(sent, 1U);
  EXPECT_LE(sent, 4U) << "fewer than the socket's own buffer holds";
  EXPECT_EQ(port.counts().expired, 0U);
  for (int i = 0; i < kLife_ms; ++i) port.poll(++now);
  EXPECT_EQ(port.counts().sent + port.counts().expired, CanPort::kSendDepth);
  EXPECT_EQ(port.state(), CanState::active);
}

// Lost arbitration, and the passive state, which shows that the error frame arrived.
TEST_F(SocketCanTest, NamesTheReasonOfWhatWasDropped) {
  shell("cansend vtest0 20000006#0020000000000000");
  ASSERT_TRUE(comes_to(CanState::passive));
  shell(kSlow);
  const auto drop_some = [&] {
    while (port.send(frame(0x111), kLife_ms)) {
    }
    const std::uint32_t before = port.counts().expired;
    for (int i = 0; i <= kLife_ms; ++i) port.poll(++now);
    return port.counts().expired - before;
  };
  const std::uint32_t outbid = drop_some();
  EXPECT_GT(outbid, 0U);
  EXPECT_EQ(port.counts().outbid, outbid);
  now += SocketCan::kBlameMs;
  port.poll(now);
  EXPECT_GT(drop_some(), 0U);
  EXPECT_EQ(port.counts().outbid, outbid);
  EXPECT_EQ(port.counts().unheard, 0U);
}

TEST_F(SocketCanTest, KnowsThatNobodyAcknowledges) {
  shell("cansend vtest0 20000024#0020000000000000");
  ASSERT_TRUE(comes_to(CanState::passive));
  shell(kSlow);
  while (port.send(frame(0x111), kLife_ms)) {
  }
  for (int i = 0; i <= kLife_ms; ++i) port.poll(++now);
  EXPECT_GT(port.counts().unheard, 0U);
  EXPECT_EQ(port.counts().unheard, port.counts().expired);
}

TEST(SocketCanNames, MustBeOnes) {
  EXPECT_THROW(SocketCan(""), SocketCanError);
  EXPECT_THROW(SocketCan("much-too-long-for-one"), SocketCanError);
  SocketCan absent("vcan99");
  absent.poll(0);
  EXPECT_EQ(absent.state(), CanState::starting);
  EXPECT_EQ(absent.waits_for(), "vcan99 does not exist");
}

}  // namespace
}  // namespace whisker::hal::socketcan
