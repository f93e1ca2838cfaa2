#include "host/bench/param_values.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace whisker::bench {
namespace {

/// Every value at and beside the ends of its range, in the words of a robot file.
TEST(ParamValues, ReadsWhatItWrites) {
  const std::vector<ParamEntry> list = param_list(Params{});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const ParamEntry& e = list[i];
    for (const std::int64_t raw : {e.low, e.low + 1, e.raw, e.high - 1, e.high}) {
      if (raw < e.low || raw > e.high) continue;
      const std::string text =
          e.word != nullptr ? words_of(i)[static_cast<std::size_t>(raw)] : e.text_of(raw);
      const Assignment read = parse_assignment(std::string(e.key) + "=" + text);
      EXPECT_EQ(read.place, i) << e.key;
      EXPECT_EQ(read.raw, raw) << e.key << " = " << text;
    }
    if (e.word != nullptr) continue;
    for (const std::int64_t raw : {e.low - (e.high - e.low), e.high + (e.high - e.low)}) {
      EXPECT_THROW(parse_assignment(std::string(e.key) + "=" + e.text_of(raw)), std::invalid_argument)
          << e.key;
    }
  }
}

TEST(ParamValues, NamesTheNearestAllowedValue) {
  const std::size_t speed = place_of("wheel_speed_max_mps");
  EXPECT_EQ(
      outside_text(speed, "9", 9000000),
      "wheel_speed_max_mps = 9: too large; it may be 0.02 to 3.2 m/s; the nearest allowed value is 3.2 m/s");
  EXPECT_EQ(
      outside_text(speed, "0", 0),
      "wheel_speed_max_mps = 0: too small; it may be 0.02 to 3.2 m/s; the nearest allowed value is 0.02 m/s");
}

TEST(ParamValues, RefusesWhatIsNoValue) {
  for (const char* text :
       {"", "=", "gyro", "gyro=", "gyro=2", "gyro=TRUE", "body_radius_m=", "body_radius_m=0.1m",
        "body_radius_m=inf", "body_radius_m=1e999", "range_rate_hz=50.5", "nothing=1"}) {
    EXPECT_THROW(parse_assignment(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace whisker::bench
