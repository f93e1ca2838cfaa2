#include "host/harness/sim/range_sensors.hpp"

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
  for (BeamSpec& beam : robot.beams) {
    beam.x = 0.05 * std::cos(beam.angle);
    beam.y = 0.05 * std::sin(beam.angle);
  }
  const double heading = 2.0;
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    const double angle = heading + robot.beams[beam].angle;
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
  const double side = robot.beams[hal::kLeft].angle;
  const Disc disc{{0.5 * std::cos(side), 0.5 * std::sin(side)}, 0.1};
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
  robot.beams[hal::kLeft].angle = 0.0872;
  robot.beams[hal::kRight].angle = -0.0872;  // the cones overlap: all three see the foot of the wall
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

struct Statuses {
  int ok = 0, clear = 0, invalid = 0, at_glass = 0;
  double sum = 0, squares = 0;
};
Statuses front_of(const RobotSpec& robot, const NoiseSpec& noise, const WorldView& world) {
  RangeSensors sensors(robot, noise, kSeed);
  Statuses s;
  for (int k = 0; k < kCount; ++k) {
    const int64_t arrival = sensors.due_us() + 20000;
    sensors.measure(world, {});
    const hal::RangeReading got = sensors.read(arrival).beam[hal::kFront];
    s.ok += got.status == hal::RangeStatus::ok ? 1 : 0;
    s.clear += got.status == hal::RangeStatus::clear ? 1 : 0;
    s.invalid += got.status == hal::RangeStatus::invalid ? 1 : 0;
    s.at_glass += got.mm == 60 ? 1 : 0;
    s.sum += got.mm * 0.001;
    s.squares += got.mm * 0.001 * got.mm * 0.001;
  }
  return s;
}

TEST(RangeSensors, OwnNoiseGrowsWithTheDistanceAndAddsToTheOther) {
  RobotSpec robot;
  robot.range_sigma = 0.003;
  robot.range_sigma_share = 0.01;
  NoiseSpec noise;
  for (const double other : {0.0, 0.008}) {
    noise.range_sigma_m = other;
    for (const double x : {0.5, 1.6}) {
      const Statuses s = front_of(robot, noise, Wall(x).world);
      ASSERT_EQ(s.ok, kCount);
      const double sigma = std::sqrt(0.003 * 0.003 + 0.0001 * x * x + other * other);
      const double mean = s.sum / kCount;
      EXPECT_NEAR(mean, x, 4 * sigma / std::sqrt(kCount) + 1e-5) << "seed " << kSeed;
      EXPECT_NEAR(std::sqrt(s.squares / kCount - mean * mean), sigma,
                  4 * sigma / std::sqrt(2.0 * kCount) + 1e-5)
          << x << ' ' << other << " seed " << kSeed;
    }
  }
}

TEST(RangeSensors, OwnNoiseDrawsTheSameNumbersAsTheOther) {
  RobotSpec noisy;
  noisy.range_sigma = 0.01;
  NoiseSpec noise;
  noise.range_sigma_m = 0.01;
  const Wall wall(1);
  RangeSensors one(noisy, {}, kSeed), other({}, noise, kSeed);
  for (int k = 0; k < 1000; ++k) {
    const int64_t arrival = one.due_us() + 20000;
    one.measure(wall.world, {});
    other.measure(wall.world, {});
    ASSERT_EQ(one.read(arrival).beam[hal::kLeft].mm, other.read(arrival).beam[hal::kLeft].mm);
  }
}

TEST(RangeSensors, LoseWhatIsTooDark) {
  RobotSpec robot;
  robot.echo_range = 0.8;
  EXPECT_EQ(measured(robot, Wall(0.7999).world).beam[hal::kFront].mm, 800);
  EXPECT_EQ(measured(robot, Wall(0.8001).world).beam[hal::kFront].status, hal::RangeStatus::clear);
  robot.dark_is_invalid = true;
  EXPECT_EQ(measured(robot, Wall(0.7999).world).beam[hal::kFront].mm, 800);
  EXPECT_EQ(measured(robot, Wall(0.8001).world).beam[hal::kFront].status, hal::RangeStatus::invalid);
  EXPECT_EQ(measured(robot, Wall(1.9999).world).beam[hal::kFront].status, hal::RangeStatus::invalid);
  EXPECT_EQ(measured(robot, Wall(2.0001).world).beam[hal::kFront].status, hal::RangeStatus::clear);
  robot.range_scale = 1.1;
  EXPECT_EQ(measured(robot, Wall(0.7).world).beam[hal::kFront].mm, 770);
  EXPECT_EQ(measured(robot, Wall(0.8001).world).beam[hal::kFront].status, hal::RangeStatus::invalid);
}

TEST(RangeSensors, FoldBackNearerThanTheMinimum) {
  RobotSpec robot;
  for (BeamSpec& beam : robot.beams) beam.min_range = 0.1;
  EXPECT_EQ(measured(robot, Wall(0.05).world).beam[hal::kFront].status, hal::RangeStatus::too_near);
  robot.near_is_farther = true;
  EXPECT_EQ(measured(robot, Wall(0.1).world).beam[hal::kFront].mm, 100);
  EXPECT_EQ(measured(robot, Wall(0.05).world).beam[hal::kFront].mm, 200);
  EXPECT_EQ(measured(robot, Wall(0.004).world).beam[hal::kFront].status, hal::RangeStatus::clear);
}

TEST(RangeSensors, TheCoverGlassTakesThePlaceOfClearReadingsOnly) {
  RobotSpec robot;
  robot.cover_glass = 0.2;
  robot.cover_glass_at = 0.06;
  const Statuses open = front_of(robot, {}, {});
  EXPECT_EQ(open.at_glass + open.clear, kCount);
  EXPECT_NEAR(open.at_glass, 0.2 * kCount, 4 * std::sqrt(0.2 * 0.8 * kCount)) << "seed " << kSeed;
  const Statuses wall = front_of(robot, {}, Wall(1).world);
  EXPECT_EQ(wall.ok, kCount);
  EXPECT_EQ(wall.at_glass, 0);
  robot.echo_range = 0.5;
  robot.dark_is_invalid = true;
  const Statuses dark = front_of(robot, {}, Wall(1).world);
  EXPECT_EQ(dark.at_glass + dark.invalid, kCount);
  EXPECT_EQ(dark.at_glass, open.at_glass) << "the world does not change which readings these are";
}

TEST(RangeSensors, TheCoverGlassComesBeforePhantomsAndDoesNotChangeTheirs) {
  RobotSpec robot;
  robot.phantom = 0.1;
  RobotSpec both = robot;
  both.cover_glass = 0.2;
  both.cover_glass_at = 0.06;
  RangeSensors one(robot, {}, kSeed), other(both, {}, kSeed);
  int glass = 0;
  for (int k = 0; k < 2000; ++k) {
    const int64_t arrival = one.due_us() + 20000;
    one.measure({}, {});
    other.measure({}, {});
    const hal::RangeReading a = one.read(arrival).beam[hal::kRight],
                            b = other.read(arrival).beam[hal::kRight];
    if (b.mm == 60) {
      ++glass;
    } else {
      ASSERT_EQ(a.mm, b.mm) << k;
    }
  }
  EXPECT_GT(glass, 300);
}

TEST(RangeSensors, ANarrowerConeFarAwayMissesWhatIsBesideTheAxis) {
  RobotSpec robot;
  robot.cone_far_half_width = robot.beams[hal::kFront].cone_half_width / 5;
  const double off = robot.beams[hal::kFront].cone_half_width * 0.8;
  const auto post = [&](double d) {
    const Disc disc{{d * std::cos(off), d * std::sin(off)}, 0.005};
    return measured(robot, {&disc, 1, nullptr, 0, nullptr, 0}).beam[hal::kFront].status;
  };
  EXPECT_EQ(post(0.3), hal::RangeStatus::ok);
  EXPECT_EQ(post(1.5), hal::RangeStatus::clear);
  robot.cone_far_half_width = robot.beams[hal::kFront].cone_half_width * 2;
  EXPECT_EQ(post(1.5), hal::RangeStatus::ok) << "a cone never widens";
}

TEST(RangeSensors, LoseSoftObstaclesFarAway) {
  RobotSpec robot;
  robot.soft_range = 0.6;
  const std::uint8_t soft = 1;
  Wall near(0.59), far(0.61);
  near.world.soft = far.world.soft = &soft;
  EXPECT_EQ(measured(robot, near.world).beam[hal::kFront].mm, 590);
  EXPECT_EQ(measured(robot, far.world).beam[hal::kFront].status, hal::RangeStatus::clear);
}

}  // namespace
}  // namespace whisker::sim
