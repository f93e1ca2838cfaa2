#include "firmware/localization/bias_filter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

namespace whisker::localization::bias_filter_test {
namespace {

using namespace whisker::literals;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kStep_s = 0.08;

/// Standard deviations, declared.
struct Gyro {
  double walk = 0.4 * kDegree / 60;     ///< rad per root of a second
  double change = 0.1 * kDegree / 600;  ///< rad/s^2

  double variance(double lasted_s) const { return walk * walk / lasted_s; }
  int64_t variance_raw(double lasted_s) const { return std::llround(variance(lasted_s) * std::exp2(48)); }
  int32_t change_raw() const { return static_cast<int32_t>(std::lround(change * std::exp2(30))); }
  BiasFilter begun() const {
    BiasFilter filter;
    filter.configure(change_raw());
    filter.begin(variance_raw(2));
    return filter;
  }
};

/// The Kalman filter as textbooks have it: x, y, heading, bias and its change, in m, rad and s.
class Textbook {
 public:
  using Row = std::array<double, 5>;

  explicit Textbook(const Gyro& gyro) : gyro_(gyro) {
    p_[3][3] = gyro.variance(2);
    p_[4][4] = gyro.change * gyro.change;
  }
  void step(double x, double y, double s, bool by_gyro) {
    std::array<Row, 5> f{};
    for (std::size_t i = 0; i < 5; ++i) f[i][i] = 1;
    f[0][2] = -y;
    f[1][2] = x;
    f[2][3] = by_gyro ? -s : 0;
    f[3][4] = s;
    std::array<Row, 5> fp{}, out{};
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j)
        for (std::size_t k = 0; k < 5; ++k) fp[i][j] += f[i][k] * p_[k][j];
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j)
        for (std::size_t k = 0; k < 5; ++k) out[i][j] += fp[i][k] * f[j][k];
    p_ = out;
    p_[3][3] += 1.2e-11 * s;
    p_[4][4] += 6e-15 * s;
  }
  /// The gains.
  Row measure(double lasted_s) {
    const double both = p_[3][3] + gyro_.variance(lasted_s);
    Row gain{}, row = p_[3];
    for (std::size_t i = 0; i < 5; ++i) gain[i] = row[i] / both;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j) p_[i][j] -= gain[i] * row[j];
    return gain;
  }
  double at(std::size_t i, std::size_t j) const { return p_[i][j]; }

 private:
  Gyro gyro_;
  std::array<Row, 5> p_{};
};

constexpr int32_t rad_per_s(double rate) { return static_cast<int32_t>(rate * 16777216); }

/// `slack`: times the rounding that the default gyro has.
void expect_as_in_the_textbook(const Gyro& gyro, int steps_between_rests, double slack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (int drive = 0; drive < 50; ++drive) {
    BiasFilter filter = gyro.begun();
    Textbook textbook(gyro);
    double heading = 0, grown = 0, lost = 0;
    for (int rest = 0; rest < 8; ++rest) {
      const int steps = 100 + static_cast<int>(any(random) * (steps_between_rests - 100));
      const double forward = 0.3 * any(random), turning = any(random) - 0.5;
      const bool by_gyro = any(random) < 0.9;
      for (int i = 0; i < steps; ++i) {
        heading += turning * kStep_s;
        const int32_t x = static_cast<int32_t>(std::lround(forward * kStep_s * std::cos(heading) * 1e6));
        const int32_t y = static_cast<int32_t>(std::lround(forward * kStep_s * std::sin(heading) * 1e6));
        grown += static_cast<double>(filter.step(x, y, 80_ms, by_gyro).heading);
        textbook.step(x * 1e-6, y * 1e-6, kStep_s, by_gyro);
      }
      EXPECT_NEAR((grown - lost) / std::exp2(40), textbook.at(2, 2), 1e-8 + 0.02 * textbook.at(2, 2));
      const double lasted = any(random) < 0.5 ? 1 : 0.2;
      // Well below a surprise.
      const double off = (any(random) - 0.5) * 2 * gyro.walk;
      BiasFilter::Covariance shrinks{};
      const BiasFilter::Learned learned = filter.measure(rad_per_s(off), gyro.variance_raw(lasted), shrinks);
      lost += static_cast<double>(shrinks.heading);
      const Textbook::Row gain = textbook.measure(lasted);
      EXPECT_NEAR(learned.bias / 65536.0, gain[3], 0.005);
      EXPECT_NEAR(learned.change * 1000.0 / std::exp2(32), gain[4], slack * 1e-5 + 0.02 * gain[4]);
      EXPECT_NEAR(learned.ahead.heading / 1048576.0, gain[2] * off, 2e-6 + 0.02 * std::fabs(gain[2] * off));
      EXPECT_NEAR(learned.ahead.x * 1e-6, gain[0] * off, slack * 1e-4 + 0.02 * std::fabs(gain[0] * off));
      EXPECT_NEAR(learned.ahead.y * 1e-6, gain[1] * off, slack * 1e-4 + 0.02 * std::fabs(gain[1] * off));
    }
  }
}

TEST(BiasFilter, LearnsAsTheTextbookDoes) { expect_as_in_the_textbook({}, 1000, 1); }

TEST(BiasFilter, LearnsAsTheTextbookDoesWhateverTheErrors) {
  for (const double walk : {0.05, 2.0, 10.0})
    for (const double warm_up : {0.01, 1.0}) {
      SCOPED_TRACE(testing::Message() << "walk " << walk << ", warm-up " << warm_up);
      expect_as_in_the_textbook({walk * kDegree / 60, warm_up * kDegree / 600}, 800, 5);
    }
}

TEST(BiasFilter, ABiasThatHasJumpedIsTakenAsItIs) {
  const Gyro gyro;
  BiasFilter filter = gyro.begun();
  for (int i = 0; i < 12; ++i) filter.step(0, 0, 5000_ms, true);
  BiasFilter::Covariance shrinks{};
  const BiasFilter::Learned learned = filter.measure(rad_per_s(2 * kDegree), gyro.variance_raw(1), shrinks);
  EXPECT_GT(learned.bias, 65536 * 0.99);
}

TEST(BiasFilter, AMeasuredPoseLeavesNothingToCorrect) {
  const Gyro gyro;
  BiasFilter filter = gyro.begun();
  for (std::size_t i = 0; i < 500; ++i) filter.step(20000, 0, 80_ms, true);
  BiasFilter::Covariance shrinks{};
  BiasFilter measured = filter;
  EXPECT_GT(std::abs(filter.measure(rad_per_s(gyro.walk), gyro.variance_raw(1), shrinks).ahead.y), 1000);
  measured.forget();
  const BiasFilter::Learned learned = measured.measure(rad_per_s(gyro.walk), gyro.variance_raw(1), shrinks);
  EXPECT_EQ(learned.ahead.y, 0);
  EXPECT_EQ(learned.ahead.heading, 0);
  EXPECT_GT(learned.bias, 0);
}

TEST(BiasFilter, SaturatesInsteadOfWrapping) {
  BiasFilter filter;
  filter.configure(INT32_MAX);
  filter.begin(INT64_C(1) << 47);
  BiasFilter::Covariance shrinks{};
  for (int i = 0; i < 3000; ++i) {
    filter.step(1048576, -1048576, 32767_ms, true);
    if (i % 100 != 99) continue;
    const BiasFilter::Learned learned =
        filter.measure(i % 200 == 99 ? INT32_MAX : INT32_MIN, INT64_C(1) << 47, shrinks);
    EXPECT_GE(learned.bias, 0);
    EXPECT_LE(learned.bias, 65536);
    EXPECT_GE(shrinks.heading, 0);
    EXPECT_GE(shrinks.xx, 0);
  }
}

}  // namespace
}  // namespace whisker::localization::bias_filter_test
