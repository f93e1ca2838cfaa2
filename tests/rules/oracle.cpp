#include "tests/rules/oracle.hpp"

#include <fl/Headers.h>

#include <cmath>
#include <limits>
#include <random>

namespace whisker::test {
namespace {

constexpr int kCoarse = 1000;
constexpr int kFine = 3000;
/// fuzzylite's tolerance of comparisons.
constexpr double kMachineEpsilon = 2e-6;

std::unique_ptr<fl::Engine> engine_of(const std::string& text, const std::string& format) {
  fl::fuzzylite::setLogging(false);
  if (format == "fis") return std::unique_ptr<fl::Engine>(fl::FisImporter().fromString(text));
  if (format == "fcl") return std::unique_ptr<fl::Engine>(fl::FclImporter().fromString(text));
  return std::unique_ptr<fl::Engine>(fl::FllImporter().fromString(text));
}

void set_resolution(fl::Engine& engine, int resolution) {
  for (fl::OutputVariable* output : engine.outputVariables()) {
    auto* integral = dynamic_cast<fl::IntegralDefuzzifier*>(output->getDefuzzifier());
    if (integral != nullptr) integral->setResolution(resolution);
    output->setDefaultValue(fl::nan);
    output->setLockPreviousValue(false);
  }
}

std::vector<double> run(fl::Engine& engine, const std::vector<double>& inputs, int resolution) {
  set_resolution(engine, resolution);
  for (std::size_t i = 0; i < inputs.size(); ++i) engine.inputVariables()[i]->setValue(inputs[i]);
  engine.process();
  std::vector<double> out;
  for (const fl::OutputVariable* output : engine.outputVariables()) out.push_back(output->getValue());
  return out;
}

std::vector<double> random_inputs(const rules::RuleBase& base, std::mt19937& random, int point) {
  std::vector<double> inputs;
  std::uniform_real_distribution<double> share(0, 1);
  for (std::size_t i = 0; i < base.inputs.size(); ++i) {
    const rules::Input& input = base.inputs[i];
    const double s = point < 4 ? ((point >> (i % 2)) & 1) : share(random);
    inputs.push_back(input.low + s * (input.high - input.low));
  }
  return inputs;
}

}  // namespace

bool comparable(const rules::RuleBase& base) {
  for (const rules::Output& output : base.outputs) {
    switch (output.defuzzifier) {
      case rules::Defuzzifier::mean_of_maxima:
      case rules::Defuzzifier::smallest_maximum:
      case rules::Defuzzifier::largest_maximum: return false;
      default: break;
    }
  }
  return true;
}

Agreement compare(const std::string& text, const std::string& format, rules::RuleBase base, int points,
                  unsigned seed) {
  base.least_strength = 1e-6;
  for (rules::Output& output : base.outputs) output.merge_terms = false;
  const rules::Inference inference(base);
  const std::unique_ptr<fl::Engine> engine = engine_of(text, format);
  std::mt19937 random(seed);
  Agreement a;
  for (int p = 0; p < points; ++p) {
    const std::vector<double> inputs = random_inputs(base, random, p);
    const std::vector<rules::Answer> ours = inference(inputs);
    const std::vector<double> coarse = run(*engine, inputs, kCoarse);
    const std::vector<double> fine = run(*engine, inputs, kFine);
    for (std::size_t o = 0; o < base.outputs.size(); ++o) {
      const double range = base.outputs[o].high - base.outputs[o].low;
      if (std::isnan(fine[o]) || !ours[o].fired) {
        if (std::isnan(fine[o]) != ours[o].fired) {
          ++a.silent;
          continue;
        }
        a.disagrees = base.outputs[o].name + ": only one of the two fires";
        return a;
      }
      ++a.points;
      const double own_error = 2 * std::abs(coarse[o] - fine[o]) + kMachineEpsilon * range + range / kFine;
      const double difference = std::abs(ours[o].value - fine[o]);
      a.greatest = std::max(a.greatest, (difference - own_error) / range);
      if (difference <= own_error || !a.disagrees.empty()) continue;
      a.disagrees = base.outputs[o].name + " = " + std::to_string(ours[o].value) + ", but fuzzylite says " +
                    std::to_string(fine[o]) + " at";
      for (const double x : inputs) a.disagrees += " " + std::to_string(x);
    }
  }
  return a;
}

}  // namespace whisker::test
