// A failed encoder or motor soon ends in a fault, and a sound one never does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

using worlds::Random;

constexpr std::uint32_t kMask = hal::kEncoderModulus - 1;

struct Failure {
  const char* name;
  std::function<void(FaultyBoard&)> strike;
  bool may_hide = false;
};

void PrintTo(const Failure& failure, std::ostream* out) { *out << failure.name; }

void freeze_left(FaultyBoard& board) {
  board.counts = [first = true, frozen = std::uint32_t{0}](hal::EncoderCounts& counts) mutable {
    if (first) frozen = counts.left;
    first = false;
    counts.left = frozen;
  };
}

void kill_left_motor(FaultyBoard& board) {
  board.wheels = [](hal::WheelSpeeds& speeds) {
    speeds.left = 0;
    return true;
  };
}

void reverse_left_encoder(FaultyBoard& board) {
  board.counts = [first = true, turn = std::uint32_t{0}](hal::EncoderCounts& counts) mutable {
    if (first) turn = counts.left;
    first = false;
    counts.left = (2 * turn - counts.left) & kMask;
  };
}

void run_left_motor_away(FaultyBoard& board) {
  board.wheels = [](hal::WheelSpeeds& speeds) {
    speeds.left = 3000;
    return true;
  };
}

/// Adds counts in every tick, like a disturbed counter.
std::function<void(FaultyBoard&)> glitch(std::uint32_t counts_a_tick) {
  return [counts_a_tick](FaultyBoard& board) {
    board.counts = [counts_a_tick, sum = std::uint32_t{0}](hal::EncoderCounts& counts) mutable {
      sum += counts_a_tick;
      counts.right = (counts.right + sum) & kMask;
    };
  };
}

class OneWheel : public testing::TestWithParam<Failure> {};

// From the start, and during a drive.
TEST_P(OneWheel, ThatFailsIsAFaultBeforeItDoesHarm) {
  std::map<std::string, int> ends;
  double farthest = 0;
  for (std::uint64_t seed = 1; seed <= test::effort(40); ++seed) {
    worlds::Options options;
    options.seed = 52000 + seed;
    Bench bench(worlds::generate(worlds::Kind::discs, options),
                seed % 2 == 0 ? PlannerKind::boundary : PlannerKind::map);
    if (seed % 4 >= 2) bench.run(2.0 + static_cast<double>(seed % 7));
    if (bench.ended() != "running") continue;
    GetParam().strike(bench.board());
    const double before = bench.plant().path_length();
    bench.run(60);
    ++ends[bench.ended()];
    farthest = std::fmax(farthest, bench.plant().path_length() - before);
  }
  for (const auto& [end, count] : ends) std::printf("%s %d  ", end.c_str(), count);
  std::printf("driven on for at most %.3f m\n", farthest);
  EXPECT_EQ(ends.count("running") + ends.count("reached") + ends.count("contact"), 0U);
  // A motor stuck at full speed may match the commands for a while.
  EXPECT_LT(farthest, GetParam().may_hide ? 20 : 0.2);
}

INSTANTIATE_TEST_SUITE_P(By, OneWheel,
                         testing::Values(Failure{"dead_encoder", freeze_left},
                                         Failure{"dead_motor", kill_left_motor},
                                         Failure{"reversed_encoder", reverse_left_encoder},
                                         Failure{"runaway_motor", run_left_motor_away, true},
                                         Failure{"glitch_of_265", glitch(265)},
                                         Failure{"glitch_of_40", glitch(40)},
                                         Failure{"glitch_of_20", glitch(20)}),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace whisker::test
