// fuzzylite as an independent judge of what the rule base means.
#include <fl/Headers.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace whisker::fuzzy {
namespace {

// Constants are given to fuzzylite as raw units / 2^14, so that only the last rounding of ours differs.
constexpr double kBound = 0.5 / Q14::kOne + 1e-9;

fl::InputVariable* input(const char* name, double low, double high, const int16_t (&centres)[kTerms]) {
  auto variable = std::make_unique<fl::InputVariable>(name, low, high);
  for (int i = 0; i < kTerms; ++i) {
    const double before = i == 0 ? -fl::inf : centres[i - 1] / 128.0;
    const double after = i == kTerms - 1 ? fl::inf : centres[i + 1] / 128.0;
    variable->addTerm(new fl::Triangle("t" + std::to_string(i), before, centres[i] / 128.0, after));
  }
  return variable.release();
}

fl::OutputVariable* output(const char* name, const Q14 (&picture)[kTerms][kTerms]) {
  auto variable = std::make_unique<fl::OutputVariable>(name, -2, 2);
  variable->setAggregation(nullptr);
  variable->setDefuzzifier(new fl::WeightedAverage("TakagiSugeno"));
  for (int i = 0; i < kTerms; ++i)
    for (int j = 0; j < kTerms; ++j)
      variable->addTerm(new fl::Constant("c" + std::to_string(i) + std::to_string(j),
                                         picture[i][j].raw() / double{Q14::kOne}));
  return variable.release();
}

std::unique_ptr<fl::Engine> fuzzylite_engine(const RuleBase& rules) {
  auto engine = std::make_unique<fl::Engine>();
  engine->addInputVariable(input("D", 0, 10, kDistanceCentres));
  engine->addInputVariable(input("R", -8, 8, kBiasCentres));
  engine->addOutputVariable(output("SA", rules.turn));
  engine->addOutputVariable(output("SD", rules.step));
  auto block = std::make_unique<fl::RuleBlock>();
  block->setConjunction(new fl::Minimum);
  block->setActivation(new fl::General);
  for (int i = 0; i < kTerms; ++i) {
    for (int j = 0; j < kTerms; ++j) {
      const std::string d = std::to_string(i);
      const std::string r = std::to_string(j);
      block->addRule(fl::Rule::parse(
          "if D is t" + d + " and R is t" + r + " then SA is c" + d + r + " and SD is c" + d + r,
          engine.get()));
    }
  }
  engine->addRuleBlock(block.release());
  return engine;
}

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
