#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "hal/boards/common/analogue_ir.hpp"
#include "hal/boards/common/governor.hpp"
#include "hal/boards/common/nearer.hpp"
#include "hal/boards/common/shared.hpp"
#include "host/harness/sim/random.hpp"

namespace whisker::hal::mcu {
namespace {

using hal::RangeReading;
using hal::RangeStatus;

TEST(RingTest, IsAQueueThatRefusesWhenFull) {
  sim::Random random(1, 0);
  Ring<int, 8> ring;
  std::deque<int> oracle;
  for (int i = 0; i < 80000; ++i) {  // its indices go round
    ASSERT_EQ(ring.size(), oracle.size());
    if (!oracle.empty()) {
      ASSERT_EQ(ring.at(static_cast<std::uint16_t>(oracle.size() - 1)), oracle.back());
    }
    if (i % 100 == 0) {
      ring.drop(static_cast<std::uint16_t>(oracle.size() / 2));
      oracle.erase(oracle.begin(), oracle.begin() + static_cast<std::ptrdiff_t>(oracle.size() / 2));
    }
    if (random.uniform() < (i / 1000 % 2 == 0 ? 0.6 : 0.4)) {
      EXPECT_EQ(ring.push(i), oracle.size() < 8);
      if (oracle.size() < 8) oracle.push_back(i);
    } else {
      int out = -1;
      ASSERT_EQ(ring.pop(out), !oracle.empty());
      if (oracle.empty()) continue;
      ASSERT_EQ(out, oracle.front());
      oracle.pop_front();
    }
  }
}

/// Two values that must agree; an interrupt may come while they are copied.
struct Pair {
  Pair() = default;
  Pair(const Pair& other) {
    a = other.a;
    if (between != nullptr) between();
    b = other.b;
  }
  Pair& operator=(const Pair& other) = default;
  int a = 0;
  int b = 0;
  static void (*between)();
};
void (*Pair::between)() = nullptr;

Latest<Pair>* shared = nullptr;
int interruptions = 0;

void publish_next() {
  if (interruptions == 0) return;
  --interruptions;
  void (*const keep)() = Pair::between;
  Pair::between = nullptr;
  Pair next;
  next.a = next.b = 100 + interruptions;
  shared->publish(next);
  Pair::between = keep;
}

TEST(LatestTest, IsReadWholeWhateverComesInBetween) {
  for (int count = 0; count < 8; ++count) {
    Latest<Pair> latest;
    shared = &latest;
    interruptions = count;
    Pair::between = publish_next;
    Pair out;
    ASSERT_TRUE(latest.read(out));
    EXPECT_EQ(out.a, out.b);
    EXPECT_EQ(out.a, count == 0 ? 0 : 100);
    Pair::between = nullptr;
  }
}

TEST(LatestTest, GivesUpWhenItIsPublishedWithoutEnd) {
  Latest<Pair> latest;
  shared = &latest;
  interruptions = 1000;
  Pair::between = publish_next;
  Pair out;
  out.a = 7;
  EXPECT_FALSE(latest.read(out));
  EXPECT_EQ(out.a, 7);
  Pair::between = nullptr;
}

TEST(EventsTest, AreCollectedOnceOverTheWrap) {
  Events events;
  int total = 0;
  for (int i = 0; i < 1000; ++i) {
    for (int k = 0; k < i % 200; ++k) events.happened();
    EXPECT_EQ(events.collect(), i % 200);
    total += i % 200;
  }
  EXPECT_GT(total, 256);
  EXPECT_EQ(events.collect(), 0);
}

TEST(AnalogueIrTest, DistanceIsTheInverseOfTheCurve) {
  for (int mm = 100; mm <= 800; ++mm) {
    RangeReading r{};
    from_voltage(kGp2y0a21, voltage_at(kGp2y0a21, static_cast<int16_t>(mm)), r);
    ASSERT_EQ(r.status, RangeStatus::ok) << mm;
    // Range step per millivolt at this distance.
    const double step = double{1} * mm * mm / kGp2y0a21.slope_mv_mm;
    EXPECT_NEAR(r.mm, mm, 1 + step / 2);
  }
}

TEST(AnalogueIrTest, NearestAndFarthestAreTheDataSheets) {
  EXPECT_NEAR(voltage_at(kGp2y0a21, 100), 2300, 1);
  EXPECT_NEAR(voltage_at(kGp2y0a21, 800), 400, 1);
}

TEST(AnalogueIrTest, EveryVoltageHasOneOfFourMeaningsInThisOrder) {
  int stage = 0;
  const RangeStatus order[] = {RangeStatus::invalid, RangeStatus::clear, RangeStatus::ok,
                               RangeStatus::too_near};
  std::uint16_t last = UINT16_MAX;
  for (int mv = 0; mv <= 5000; ++mv) {
    RangeReading r{};
    from_voltage(kGp2y0a21, static_cast<int16_t>(mv), r);
    while (order[stage] != r.status) ASSERT_LT(++stage, 4) << mv;
    if (r.status != RangeStatus::ok) continue;
    EXPECT_LE(r.mm, last);
    last = r.mm;
  }
  EXPECT_EQ(stage, 3);
}

class Fixed final : public hal::Rangefinders {
 public:
  bool read(hal::RangeReadings& out) noexcept override {
    if (!answers) return false;
    for (RangeReading& r : out.beam) r = reading;
    return true;
  }
  RangeReading reading{};
  bool answers = true;
};

TEST(NearerTest, ShowsTheNearerAndNeverMoreThanTheLeadingOneHas) {
  const RangeReading all[] = {{500, RangeStatus::ok, 3, 4},    {300, RangeStatus::ok, 3, 4},
                              {0, RangeStatus::clear, 3, 4},   {0, RangeStatus::too_near, 3, 4},
                              {0, RangeStatus::invalid, 3, 4}, {0, RangeStatus::stale, 3, 4}};
  // Rank by distance; lost readings have none.
  const auto nearness = [](const RangeReading& r) {
    return r.status == RangeStatus::too_near ? -1 : r.status == RangeStatus::ok ? r.mm : 1000000;
  };
  for (const RangeReading& a : all) {
    for (RangeReading b : all) {
      b.sequence = 9;
      b.age_ms = 77;
      Fixed leading;
      Fixed second;
      leading.reading = a;
      second.reading = b;
      Nearer both(leading, second);
      hal::RangeReadings out{};
      ASSERT_TRUE(both.read(out));
      const bool lost = a.status == RangeStatus::invalid || a.status == RangeStatus::stale;
      const RangeReading& expected = !lost && nearness(b) < nearness(a) ? b : a;
      for (const RangeReading& r : out.beam) {
        EXPECT_EQ(r.status, expected.status);
        EXPECT_EQ(r.mm, expected.mm);
        EXPECT_EQ(r.age_ms, expected.age_ms);
        EXPECT_EQ(r.sequence, 4);
      }
    }
  }
}

TEST(NearerTest, OnlyTheLeadingOnesRefusalIsARefusal) {
  Fixed leading;
  Fixed second;
  leading.reading = {400, RangeStatus::ok, 0, 1};
  second.answers = false;
  Nearer both(leading, second);
  hal::RangeReadings out{};
  EXPECT_TRUE(both.read(out));
  EXPECT_EQ(out.beam[0].mm, 400);
  leading.answers = false;
  EXPECT_FALSE(both.read(out));
}

/// A wheel with a lag, whose motor gain differs from the parameters.
double settled_speed(const MotorParams& params, int16_t wanted, double gain, double lag_s) {
  Governor governor(params);
  double v = 0;
  double way = 0;
  int counted = 0;
  double sum = 0;
  for (int tick = 0; tick < 1000; ++tick) {
    const int counts = static_cast<int>(std::floor(way * params.counts_per_metre));
    const int16_t duty = governor.step(wanted, static_cast<int16_t>(counts - counted), 10);
    counted = counts;
    for (int i = 0; i < 10; ++i) {
      v += (gain * duty / 32767.0 * params.full_speed * 1e-4 - v) * 0.001 / lag_s;
      way += v * 0.001;
    }
    if (tick >= 500) sum += v;
  }
  return sum / 500;
}

TEST(GovernorTest, TakesOutAWrongGain) {
  const MotorParams params{};
  for (const double gain : {0.85, 0.9, 1.0, 1.1, 1.2}) {
    for (const int wanted : {-2500, -700, 300, 1500, 2500}) {
      EXPECT_NEAR(settled_speed(params, static_cast<int16_t>(wanted), gain, 0.05), wanted * 1e-4, 1e-3)
          << gain << ' ' << wanted;
    }
  }
}

TEST(GovernorTest, AddsNoMoreThanItsMostLagIsWorth) {
  const MotorParams params{};
  const double most = params.most_lag * 1e-7 * params.stiffness_per_s;
  EXPECT_NEAR(settled_speed(params, 2000, 0.5, 0.05), 0.5 * (0.2 + most), 1e-3);
}

TEST(GovernorTest, StopsAtOnceAndForgetsItsLag) {
  const MotorParams params{};
  Governor governor(params);
  for (int i = 0; i < 100; ++i) governor.step(2000, 0, 10);
  EXPECT_GT(governor.step(2000, 0, 10), 2000 * 32767 / 4000);
  EXPECT_EQ(governor.step(0, 0, 10), 0);
  EXPECT_EQ(governor.step(2000, 0, 10), 2000 * 32767 / 4000);
}

TEST(GovernorTest, IsOddAndWithinFullDutyForEveryInput) {
  sim::Random random(2, 0);
  const auto draw = [&random](double low, double high) {
    return static_cast<std::int32_t>(low + (high - low) * random.uniform());
  };
  for (int run = 0; run < 300; ++run) {
    MotorParams params;
    params.full_speed = static_cast<int16_t>(draw(100, 32768));
    params.counts_per_metre = draw(100, 1000001);
    params.stiffness_per_s = static_cast<uint8_t>(draw(0, 256));
    params.most_lag = draw(0, 1000001);
    Governor a(params);
    Governor b(params);
    for (int i = 0; i < 50; ++i) {
      const auto wanted = static_cast<int16_t>(draw(-32767, 32768));
      const auto counted = static_cast<int16_t>(draw(-32767, 32768));
      const auto ms = static_cast<uint8_t>(draw(0, 256));
      const int16_t duty = a.step(wanted, counted, ms);
      EXPECT_GE(duty, -Governor::kFullDuty);
      EXPECT_EQ(b.step(static_cast<int16_t>(-wanted), static_cast<int16_t>(-counted), ms), -duty);
    }
  }
}

}  // namespace
}  // namespace whisker::hal::mcu
