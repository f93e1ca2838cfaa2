// Compares the rule base with fuzzylite, an independent implementation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/fuzzylite_engine.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

// fuzzylite gets constants as raw units / 2^14, so that only our final rounding differs.
constexpr double kBound = 0.5 / Q14::kOne + 1e-9;

TEST(Exact, AgreesWithFuzzyliteOnADenseGrid) {
  const auto engine = fuzzylite_engine(kRules);
  std::string why;
  ASSERT_TRUE(engine->isReady(&why)) << why;
  const Exact exact{kRules};
  double largest = 0;
  int count = 0;
  for (int d = 0; d <= kDistanceMax; d += 5) {
    for (int r = -kBiasMax; r <= kBiasMax; r += 8) {
      engine->setInputValue("D", d / 128.0);
      engine->setInputValue("R", r / 128.0);
      engine->process();
      const Response response = exact(inputs(d, r));
      const double turn_error = response.turn.raw() / double{Q14::kOne} - engine->getOutputValue("SA");
      const double step_error = response.step.raw() / double{Q14::kOne} - engine->getOutputValue("SD");
      ASSERT_TRUE(std::isfinite(turn_error) && std::isfinite(step_error)) << d << ' ' << r;
      largest = std::max({largest, std::abs(turn_error), std::abs(step_error)});
      ++count;
    }
  }
  std::printf("fuzzylite: max difference %.7f on %d inputs\n", largest, count);
  EXPECT_LE(largest, kBound);
}

}  // namespace
}  // namespace whisker::fuzzy
