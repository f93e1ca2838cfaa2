#include "host/sim/range_sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace whisker::sim {
namespace {

constexpr std::uint64_t kSeed = 4711;
constexpr int kCount = 40000;

/// A wall across the front beam's axis; it is farther away for the side beams of the reference robot.
struct Wall {
  explicit Wall(double x) : segment{{x, -50}, {x, 50}} {}
  Segment segment;
  WorldView world{nullptr, 0, &segment, 1, nullptr, 0};
};

hal::RangeReadings measured(const RobotSpec& robot, const WorldView& world, Pose pose = {}) {
  RangeSensors sensors(robot, {}, kSeed);
  sensors.measure(world, pose);
  return sensors.read(static_cast<int64_t>(robot.latency_s * 1e6));
}

TEST(RangeSensors, AreStaleUntilTheFirstMeasurementArrives) {
  const Wall wall(1);
  RangeSensors sensors({}, {}, kSeed);
  sensors.measure(wall.world, {});
  for (const hal::RangeReading& reading : sensors.read(19999).beam) {
    EXPECT_EQ(reading.status, hal::RangeStatus::stale);
    EXPECT_EQ(reading.age_ms, 255);
    EXPECT_EQ(reading.sequence, 15);
  }
  for (const hal::RangeReading& reading : sensors.read(20000).beam) {
    EXPECT_EQ(reading.status, hal::RangeStatus::ok);
    EXPECT_EQ(reading.age_ms, 20);
    EXPECT_EQ(reading.sequence, 0);
  }
}

TEST(RangeSensors, WithoutLatencyTheFirstIsThereAtTimeZero) {
  RobotSpec robot;
  robot.latency_s = 0;
  const hal::RangeReading front = measured(robot, Wall(1).world).beam[hal::kFront];
  EXPECT_EQ(front.status, hal::RangeStatus::ok);
  EXPECT_EQ(front.age_ms, 0);
}

TEST(RangeSensors, MeasureAtExactMultiplesOfTheirRateForHours) {
  RobotSpec robot;
  robot.rate_hz = 30;
  RangeSensors sensors(robot, {}, kSeed);
  for (int64_t k = 0; k < 1000000; ++k) {
    ASSERT_EQ(sensors.due_us(), (k * 1000000 + 15) / 30) << k;
    sensors.measure({}, {});
  }
}

TEST(RangeSensors, SequenceAndAgeTellWhichMeasurementItIs) {
  RobotSpec robot;
  robot.rate_hz = 100;
  robot.latency_s = 0.2;  // twenty in flight
  RangeSensors sensors(robot, {}, kSeed);
  for (int64_t k = 0; k < 100; ++k) {
    sensors.measure({}, {});
    if (k < 20) continue;
    for (const int after_ms : {0, 4, 9}) {
      const hal::RangeReading reading = sensors.read(k * 10000 + after_ms * 1000).beam[hal::kLeft];
      ASSERT_EQ(reading.sequence, (k - 20) % 16) << k;
      ASSERT_EQ(reading.age_ms, 200 + after_ms) << k;
    }
  }
  EXPECT_EQ(sensors.read(1000000000).beam[hal::kLeft].age_ms, 255);
}

TEST(RangeSensors, ClassifyByTheirRange) {
  const RobotSpec robot;
  const auto front = [&](double x) { return measured(robot, Wall(x).world).beam[hal::kFront]; };
  EXPECT_EQ(front(0.0199).status, hal::RangeStatus::too_near);
  EXPECT_EQ(front(0.0201).status, hal::RangeStatus::ok);
  EXPECT_EQ(front(0.0201).mm, 20);
  EXPECT_EQ(front(1.2344).mm, 1234);
  EXPECT_EQ(front(1.2346).mm, 1235);
  EXPECT_EQ(front(1.9999).status, hal::RangeStatus::ok);
  EXPECT_EQ(front(1.9999).mm, 2000);
  EXPECT_EQ(front(2.0001).status, hal::RangeStatus::clear);
}

TEST(RangeSensors, LookLeftAheadAndRightOfTheBody) {
  RobotSpec robot;
  robot.offset = 0.05;
  const double heading = 2.0;
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    const double angle = heading + (1 - beam) * robot.side_angle;
    const Disc disc{{3 + 1.0 * std::cos(angle), -2 + 1.0 * std::sin(angle)}, 0.1};
    const hal::RangeReadings got = measured(robot, {&disc, 1, nullptr, 0, nullptr, 0}, {{3, -2}, heading});
    for (int other = 0; other < hal::kBeams; ++other) {
      EXPECT_EQ(got.beam[other].status, other == beam ? hal::RangeStatus::ok : hal::RangeStatus::clear);
    }
    EXPECT_EQ(got.beam[beam].mm, 850) << beam;
  }
}

TEST(RangeSensors, ScaleEveryDistance) {
  RobotSpec robot;
  robot.range_scale = 1.1;
  EXPECT_EQ(measured(robot, Wall(1).world).beam[hal::kFront].mm, 1100);
  EXPECT_EQ(measured(robot, Wall(1.8).world).beam[hal::kFront].mm, 1980);
  EXPECT_EQ(measured(robot, Wall(1.9).world).beam[hal::kFront].status, hal::RangeStatus::clear);
  robot.range_scale = 0.9;
  EXPECT_EQ(measured(robot, Wall(2.1).world).beam[hal::kFront].mm, 1890);
}

TEST(RangeSensors, LoseAWallThatIsTooOblique) {
  RobotSpec robot;
  robot.incidence = 15 * kPi / 180;
  const hal::RangeReadings got = measured(robot, Wall(1).world);
  EXPECT_EQ(got.beam[hal::kFront].mm, 1000);
  EXPECT_EQ(got.beam[hal::kLeft].status, hal::RangeStatus::clear) << "its nearest edge is 17.5 degrees off";
  robot.incidence = 18 * kPi / 180;
  EXPECT_EQ(measured(robot, Wall(1).world).beam[hal::kLeft].status, hal::RangeStatus::ok);
}

struct Counted {
  int phantoms = 0;
  int others = 0;
  double sum = 0;
};
Counted count_phantoms(const RobotSpec& robot, const WorldView& world, int usual_mm) {
  RangeSensors sensors(robot, {}, kSeed);
  Counted c;
  for (int k = 0; k < kCount; ++k) {
    const int64_t arrival = sensors.due_us() + 20000;
    sensors.measure(world, {});
    const hal::RangeReading got = sensors.read(arrival).beam[hal::kFront];
    const bool usual = usual_mm == 0 ? got.status == hal::RangeStatus::clear : got.mm == usual_mm;
    if (usual) continue;
    const bool near = got.status == hal::RangeStatus::ok && got.mm >= 100 && got.mm <= 500;
    ++(near ? c.phantoms : c.others);
    c.sum += got.mm;
  }
  return c;
}

TEST(RangeSensors, PhantomsTakeThePlaceOfClearReadingsOnly) {
  RobotSpec robot;
  robot.phantom = 0.1;
  const Counted c = count_phantoms(robot, {}, 0);
  EXPECT_EQ(c.others, 0);
  EXPECT_NEAR(c.phantoms, 0.1 * kCount, 4 * std::sqrt(0.1 * 0.9 * kCount)) << "seed " << kSeed;
  EXPECT_NEAR(c.sum / c.phantoms, 300, 4 * 115.5 / std::sqrt(c.phantoms)) << "seed " << kSeed;
  const Counted none = count_phantoms(robot, Wall(1).world, 1000);
  EXPECT_EQ(none.phantoms + none.others, 0);
}

TEST(RangeSensors, CrosstalkShowsANearerNeighbour) {
  RobotSpec robot;
  robot.crosstalk = 0.3;
  const Disc disc{{0.5 * std::cos(robot.side_angle), 0.5 * std::sin(robot.side_angle)}, 0.1};
  RangeSensors sensors(robot, {}, kSeed);
  int front = 0;
  for (int k = 0; k < kCount; ++k) {
    const int64_t arrival = sensors.due_us() + 20000;
    sensors.measure({&disc, 1, nullptr, 0, nullptr, 0}, {});
    const hal::RangeReadings got = sensors.read(arrival);
    ASSERT_EQ(got.beam[hal::kLeft].mm, 400) << "no neighbour is nearer";
    ASSERT_EQ(got.beam[hal::kRight].status, hal::RangeStatus::clear) << "the left beam is not beside it";
    front += got.beam[hal::kFront].mm == 400 ? 1 : 0;
  }
  EXPECT_NEAR(front, 0.3 * kCount, 4 * std::sqrt(0.3 * 0.7 * kCount)) << "seed " << kSeed;
}

TEST(RangeSensors, NoiseHasItsMeanAndSigmaAndIsIndependentBetweenBeams) {
  RobotSpec robot;
  robot.side_angle = 0.0872;  // the cones overlap: all three see the foot of the wall
  NoiseSpec noise;
  noise.range_sigma_m = 0.02;
  const Wall wall(1);
  RangeSensors sensors(robot, noise, kSeed);
  double sum = 0, squares = 0, product = 0;
  for (int k = 0; k < kCount; ++k) {
    const int64_t arrival = sensors.due_us() + 20000;
    sensors.measure(wall.world, {});
    const hal::RangeReadings got = sensors.read(arrival);
    double error[hal::kBeams];
    for (int i = 0; i < hal::kBeams; ++i) {
      ASSERT_EQ(got.beam[i].status, hal::RangeStatus::ok);
      error[i] = got.beam[i].mm * 0.001 - 1;
      sum += error[i];
      squares += error[i] * error[i];
    }
    product += error[0] * error[1] + error[1] * error[2] + error[0] * error[2];
  }
  const double n = 3.0 * kCount;
  EXPECT_NEAR(sum / n, 0, 4 * 0.02 / std::sqrt(n)) << "seed " << kSeed;
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 4 * 0.02 / std::sqrt(2 * n)) << "seed " << kSeed;
  EXPECT_NEAR(product / n, 0, 4 * 0.0004 / std::sqrt(n)) << "seed " << kSeed;
}

TEST(RangeSensors, NoiseMayPushAReadingOutOfRangeEitherWay) {
  NoiseSpec noise;
  noise.range_sigma_m = 0.02;
  const struct {
    double x;
    hal::RangeStatus beyond;
  } cases[] = {{1.9999999, hal::RangeStatus::clear}, {0.0200001, hal::RangeStatus::too_near}};
  for (const auto& c : cases) {
    const Wall wall(c.x);
    RangeSensors sensors({}, noise, kSeed);
    int beyond = 0;
    for (int k = 0; k < kCount; ++k) {
      const int64_t arrival = sensors.due_us() + 20000;
      sensors.measure(wall.world, {});
      const hal::RangeStatus status = sensors.read(arrival).beam[hal::kFront].status;
      ASSERT_TRUE(status == hal::RangeStatus::ok || status == c.beyond);
      beyond += status == c.beyond ? 1 : 0;
    }
    EXPECT_NEAR(beyond, kCount / 2.0, 4 * 0.5 * std::sqrt(double{kCount})) << c.x << " seed " << kSeed;
  }
}

TEST(RangeSensors, DropoutsAndFalseClearsComeAtTheirRates) {
  NoiseSpec noise;
  noise.range_dropout = 0.1;
  noise.range_false_clear = 0.2;
  const Wall wall(1);
  RangeSensors sensors({}, noise, kSeed);
  int lost = 0, clear = 0;
  for (int k = 0; k < kCount; ++k) {
    const int64_t arrival = sensors.due_us() + 20000;
    sensors.measure(wall.world, {});
    for (const hal::RangeReading& reading : sensors.read(arrival).beam) {
      lost += reading.status == hal::RangeStatus::invalid ? 1 : 0;
      clear += reading.status == hal::RangeStatus::clear ? 1 : 0;
    }
  }
  // A lost reading cannot be wrongly clear too.
  const double n = 3.0 * kCount, p = 0.2 * 0.9;
  EXPECT_NEAR(lost, 0.1 * n, 4 * std::sqrt(0.1 * 0.9 * n)) << "seed " << kSeed;
  EXPECT_NEAR(clear, p * n, 4 * std::sqrt(p * (1 - p) * n)) << "seed " << kSeed;
}

TEST(RangeSensors, TheWorldDoesNotChangeWhichReadingsAreLost) {
  NoiseSpec noise;
  noise.range_sigma_m = 0.01;
  noise.range_dropout = 0.3;
  noise.range_false_clear = 0.3;
  const Wall wall(1);
  NoiseSpec no_false_clear = noise;
  no_false_clear.range_false_clear = 0;
  no_false_clear.range_sigma_m = 0;
  RangeSensors seeing({}, noise, kSeed), blind({}, noise, kSeed), quieter({}, no_false_clear, kSeed);
  int lost = 0;
  for (int k = 0; k < 2000; ++k) {
    const int64_t arrival = seeing.due_us() + 20000;
    seeing.measure(wall.world, {});
    blind.measure({}, {});
    quieter.measure(wall.world, {});
    for (int i = 0; i < hal::kBeams; ++i) {
      const bool is_lost = seeing.read(arrival).beam[i].status == hal::RangeStatus::invalid;
      ASSERT_EQ(is_lost, blind.read(arrival).beam[i].status == hal::RangeStatus::invalid) << k;
      ASSERT_EQ(is_lost, quieter.read(arrival).beam[i].status == hal::RangeStatus::invalid) << k;
      lost += is_lost ? 1 : 0;
    }
  }
  EXPECT_GT(lost, 1000);
}

}  // namespace
}  // namespace whisker::sim
