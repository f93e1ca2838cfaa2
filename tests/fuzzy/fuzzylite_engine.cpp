#include "tests/fuzzy/fuzzylite_engine.hpp"

#include <string>

#include "firmware/math/fixed.hpp"

namespace whisker::fuzzy {
namespace {

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

}  // namespace

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

}  // namespace whisker::fuzzy
