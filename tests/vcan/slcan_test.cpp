// Linux's SLCAN driver as the other end: our port acts as a USB-CAN adapter. slcand creates its interface
// only in the first network namespace, so this needs a separate machine, the micro-VM.
#include "hal/ports/slcan/slcan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "tests/bus/frames.hpp"
#include "tests/vcan/tools.hpp"

namespace whisker::hal::slcan {
namespace {

using bus::frame;
using bus::kLife_ms;
using bus::remote;
using bus::taken;
using ::testing::ElementsAre;
using vcan::Running;
using vcan::shell;

/// The master end of a pseudo terminal, which has no path.
class Master final : public ByteLine {
 public:
  Master() : file_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (grantpt(file_) != 0 || unlockpt(file_) != 0) throw std::runtime_error("no pseudo terminal");
  }
  ~Master() { hang_up(); }
  void hang_up() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }
  std::string path() const { return ptsname(file_); }
  size_t take(uint8_t* to, size_t room) noexcept override {
    const ssize_t got = ::read(file_, to, room);
    return got > 0 ? static_cast<size_t>(got) : 0;
  }
  size_t offer(const uint8_t* from, size_t count) noexcept override {
    const ssize_t put = ::write(file_, from, count);
    return put > 0 ? static_cast<size_t>(put) : 0;
  }
  bool ready() noexcept override { return true; }

 private:
  int file_;
};

class SlcanDriver : public ::testing::Test {
 protected:
  void SetUp() override {
    shell("slcand -o -s6 " + master.path() + " slcan7 && ip link set slcan7 up");
    for (int i = 0; i < 100; ++i) port.poll(++now);
    ASSERT_EQ(port.state(), CanState::active);
  }
  void TearDown() override {
    shell("pkill -x slcand");
    master.hang_up();
    EXPECT_TRUE(soon([] { return shell("ip -br link").find("slcan7") == std::string::npos; }));
  }
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
  std::uint32_t now = 0;
  Master master;
  Slcan port{master, Role::adapter};
};

TEST_F(SlcanDriver, ReceivesWhatCansendSendsThere) {
  shell("cansend slcan7 123#1122334455667788 && cansend slcan7 12345678#AA && cansend slcan7 321#R4");
  std::vector<CanFrame> frames;
  soon([&] {
    for (const CanFrame& f : taken(port)) frames.push_back(f);
    return frames.size() >= 3;
  });
  const CanFrame full{0x123, false, false, 8, {0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88}};
  EXPECT_THAT(frames, ElementsAre(full, CanFrame{0x12345678, true, false, 1, {0xAA}}, remote(0x321, 4)));
}

TEST_F(SlcanDriver, SendsWhatCandumpShowsThere) {
  const std::string list = "grep -c 'slcan7.*raw' /proc/self/net/can/rcvlist_all || true";
  const std::string before = shell(list);
  Running candump("timeout 20 candump -L -n 3 slcan7");
  ASSERT_TRUE(soon([&] { return shell(list) != before; }));
  for (const CanFrame& f : {frame(0x700, 8, 0x10), frame(0x1FFFFFFF, 3, 0xF0), remote(0x123)}) {
    ASSERT_TRUE(port.send(f, kLife_ms));
  }
  port.poll(++now);
  EXPECT_THAT(candump.wait(),
              ::testing::ContainsRegex("slcan7 700#1011121314151617\n.*slcan7 1FFFFFFF#F0F1F2\n"
                                       ".*slcan7 123#R0?\n$"));
}

}  // namespace
}  // namespace whisker::hal::slcan
