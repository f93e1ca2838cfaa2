// The sonars of the Arduino sketch, on models of three HC-SR04.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>

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
  if (i >= 0 && value == LOW) sensor[i].trigger();
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
      sonars.poll();
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

 private:
  std::uint8_t sequence_ = 255;
};

using Seen = std::map<RangeStatus, int>;

TEST_F(SketchSonarsTest, MeasureWallsAndTellOpenGround) {
  front.metres = 0.5;
  pass(100);
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::ok, 10}}));
  EXPECT_NEAR(mm, 500, 6);
  front.metres = 0;
  pass(100);
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::clear, 10}}));
  front.metres = 0.3;
  pass(100);
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::ok, 10}}));
}

TEST_F(SketchSonarsTest, ASensorThatIsUnpluggedProvesNothing) {
  front.plugged = false;
  for (const bool floats : {false, true}) {
    front.high = floats;
    pass(100);
    EXPECT_EQ(pass(510), (Seen{{RangeStatus::invalid, 10}})) << floats;
  }
}

TEST_F(SketchSonarsTest, AnEchoThatNeverEndsIsClearOnceAtMost) {
  front.hangs_without_echo = true;
  pass(100);
  front.metres = 0.3;
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::invalid, 10}}));
}

TEST_F(SketchSonarsTest, ARiseThatNoTriggerCausedIsNoAnswer) {
  front.rises_after = 5000;
  pass(100);
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::invalid, 10}}));
}

TEST_F(SketchSonarsTest, ACloneThatEndsItsEchoLateIsHeardBetween) {
  front.no_echo = 200000;
  const Seen seen = pass(2040);
  EXPECT_GE(seen.at(RangeStatus::clear), 7);
  EXPECT_EQ(seen.count(RangeStatus::ok), 0U);
  front.metres = 0.3;
  pass(300);
  EXPECT_EQ(pass(510), (Seen{{RangeStatus::ok, 10}}));
}

}  // namespace
