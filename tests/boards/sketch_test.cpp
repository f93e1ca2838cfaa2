// The sonars of the Arduino sketch, on models of three HC-SR04.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "tests/build/fixtures/arduino/Arduino.h"
// The sketch itself needs none of these.
#undef abs
#undef min
#undef max
#undef round

#pragma GCC diagnostic ignored "-Wshadow"  // the sketch's globals have names that the core uses too
#include "toolchain/package/arduino/examples/drive/drive.ino"

namespace {

std::uint64_t now_us;
std::map<int, void (*)()> on_change;

struct HcSr04 {
  bool plugged = true;
  double metres = 0;  // 0: nothing in range
  std::uint64_t rises_after = 450;
  std::uint64_t no_echo = 38000;
  bool hangs_without_echo = false;
  bool high = false;
  std::uint64_t rise = UINT64_MAX, fall = UINT64_MAX;

  void trigger() {
    if (!plugged || rise != UINT64_MAX || high) return;
    rise = now_us + rises_after;
    const bool echo = metres > 0;
    fall = !echo && hangs_without_echo
               ? UINT64_MAX
               : rise + (echo ? static_cast<std::uint64_t>(metres * 2e6 / 343) : no_echo);
  }
};
HcSr04 sensor[3];

struct Trigger {
  int sensor;
  std::uint64_t at_us;
};
std::vector<Trigger> triggered;

int sensor_of(const std::uint8_t (&pins)[3], int pin) {
  for (int i = 0; i < 3; ++i) {
    if (pins[i] == pin) return i;
  }
  return -1;
}

void step() {
  now_us += 10;
  for (int i = 0; i < 3; ++i) {
    HcSr04& s = sensor[i];
    const bool was = s.high;
    if (now_us >= s.rise) {
      s.high = true;
      s.rise = UINT64_MAX;
    }
    if (s.high && now_us >= s.fall) {
      s.high = false;
      s.fall = UINT64_MAX;
    }
    if (s.high != was) on_change[kEcho[i]]();
  }
}

}  // namespace

void sei() {}
void cli() {}
std::uint32_t millis() { return static_cast<std::uint32_t>(now_us / 1000); }
std::uint32_t micros() { return static_cast<std::uint32_t>(now_us); }
void delayMicroseconds(unsigned int us) { now_us += us; }
void pinMode(std::uint8_t, std::uint8_t) {}
void analogWrite(std::uint8_t, int) {}
int digitalRead(std::uint8_t pin) {
  const int i = sensor_of(kEcho, pin);
  return i >= 0 && sensor[i].high ? HIGH : LOW;
}
void digitalWrite(std::uint8_t pin, std::uint8_t value) {
  const int i = sensor_of(kTrigger, pin);
  if (i < 0 || value != LOW) return;
  triggered.push_back({i, now_us});
  sensor[i].trigger();
}
void attachInterrupt(std::uint8_t pin, void (*handler)(), int) { on_change[pin] = handler; }
void HardwareSerial::begin(unsigned long) {}
void HardwareSerial::print(const char*) {}
void HardwareSerial::println(const char*) {}
HardwareSerial Serial;

namespace {

using hal::RangeStatus;

class SketchSonarsTest : public testing::Test {
 protected:
  SketchSonarsTest() {
    for (HcSr04& s : sensor) s = {};
    setup();
    pass(200);
  }
  /// The number of the front's readings of each status.
  std::map<RangeStatus, int> pass(int ms) {
    std::map<RangeStatus, int> seen;
    for (int i = 0; i < ms; ++i) {
      for (int k = 0; k < 100; ++k) step();
      if (i % between_polls_ms == 0) ping(sonars.take_turn(micros()));
      hal::RangeReadings all{};
      sonars.read(all);
      const hal::RangeReading& reading = all.beam[hal::kFront];
      if (reading.sequence != sequence_) ++seen[reading.status];
      sequence_ = reading.sequence;
      mm = reading.mm;
    }
    return seen;
  }
  HcSr04& front = sensor[hal::kFront];
  unsigned mm = 0;
  int between_polls_ms = 1;

 private:
  std::uint8_t sequence_ = 255;
};

using Seen = std::map<RangeStatus, int>;

std::set<RangeStatus> kinds(const Seen& seen) {
  std::set<RangeStatus> all;
  for (const auto& [status, times] : seen) all.insert(status);
  return all;
}

TEST_F(SketchSonarsTest, MeasureWallsAndTellOpenGround) {
  front.metres = 0.5;
  pass(100);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::ok, 10}}));
  EXPECT_NEAR(mm, 500, 6);
  // Below range_min_m, the core takes it for too_near.
  front.metres = 0.01;
  pass(100);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::ok, 10}}));
  EXPECT_LT(mm, 20U);
  front.metres = 3.6;
  pass(100);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::clear, 10}}));
  front.metres = 0;
  pass(100);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::clear, 10}}));
  front.metres = 0.3;
  pass(100);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::ok, 10}}));
}

TEST_F(SketchSonarsTest, ASensorThatIsUnpluggedProvesNothing) {
  front.plugged = false;
  for (const bool floats : {false, true}) {
    front.high = floats;
    pass(100);
    EXPECT_EQ(pass(600), (Seen{{RangeStatus::invalid, 10}})) << floats;
  }
}

TEST_F(SketchSonarsTest, AnEchoThatNeverEndsProvesNothing) {
  front.hangs_without_echo = true;
  pass(60);
  EXPECT_EQ(kinds(pass(300)), std::set{RangeStatus::invalid});
  front.metres = 0.3;
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::invalid, 10}}));
}

TEST_F(SketchSonarsTest, ARiseThatNoTriggerCausedIsNoAnswer) {
  front.rises_after = 5000;
  front.metres = 0.2;
  for (const int ms : {1, 8}) {
    between_polls_ms = ms;
    pass(100);
    EXPECT_EQ(kinds(pass(600)), std::set{RangeStatus::invalid}) << ms;
  }
}

TEST_F(SketchSonarsTest, ASensorThatEndsItsEchoAfterMoreThanARoundProvesNothingInOpenGround) {
  front.no_echo = 200000;
  pass(100);
  EXPECT_EQ(kinds(pass(600)), std::set{RangeStatus::invalid});
  front.metres = 0.3;
  pass(300);
  EXPECT_EQ(pass(600), (Seen{{RangeStatus::ok, 10}}));
}

TEST_F(SketchSonarsTest, EdgesSeenLateAfterAPauseProveNothing) {
  front.metres = 0.5;
  pass(100);
  for (int i = 0; i < 60; ++i) {
    pass(1);
    if (front.high) break;
  }
  ASSERT_TRUE(front.high);
  now_us += 45000;
  EXPECT_EQ(pass(5), (Seen{{RangeStatus::invalid, 1}}));
  EXPECT_EQ(pass(60), (Seen{{RangeStatus::ok, 1}}));
}

TEST_F(SketchSonarsTest, TakeTurnsOf20Milliseconds) {
  triggered.clear();
  pass(600);
  ASSERT_GE(triggered.size(), 29U);
  for (std::size_t i = 1; i < triggered.size(); ++i) {
    EXPECT_EQ(triggered[i].sensor, (triggered[i - 1].sensor + 1) % 3);
    EXPECT_GE(triggered[i].at_us - triggered[i - 1].at_us, 20000U);
    EXPECT_LE(triggered[i].at_us - triggered[i - 1].at_us, 21000U);
  }
}

}  // namespace
