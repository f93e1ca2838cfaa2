#include "firmware/apps/float_inference.hpp"

namespace whisker::images {
namespace {

constexpr float kDistance[fuzzy::kTerms] = {1, 3, 5, 7, 9};
constexpr float kBias[fuzzy::kTerms] = {-7, -4, 0, 4, 7};

float membership(const float (&centres)[fuzzy::kTerms], int i, float x) noexcept {
  if (i == 0 && x <= centres[0]) return 1;
  if (i == fuzzy::kTerms - 1 && x >= centres[i]) return 1;
  if (i > 0 && x > centres[i - 1] && x <= centres[i])
    return (x - centres[i - 1]) / (centres[i] - centres[i - 1]);
  if (i < fuzzy::kTerms - 1 && x >= centres[i] && x < centres[i + 1]) {
    return (centres[i + 1] - x) / (centres[i + 1] - centres[i]);
  }
  return 0;
}

}  // namespace

FloatResponse infer(const FloatRules& rules, float distance, float bias) noexcept {
  float turn = 0;
  float step = 0;
  float total = 0;
  for (int i = 0; i < fuzzy::kTerms; ++i) {
    const float of_distance = membership(kDistance, i, distance);
    if (of_distance <= 0) continue;
    for (int j = 0; j < fuzzy::kTerms; ++j) {
      const float of_bias = membership(kBias, j, bias);
      if (of_bias <= 0) continue;
      const float weight = of_distance < of_bias ? of_distance : of_bias;
      turn += weight * rules.turn[i][j];
      step += weight * rules.step[i][j];
      total += weight;
    }
  }
  return {turn / total, step / total};
}

FloatRules as_float(const fuzzy::RuleBase& rules) noexcept {
  FloatRules result{};
  for (int i = 0; i < fuzzy::kTerms; ++i) {
    for (int j = 0; j < fuzzy::kTerms; ++j) {
      result.turn[i][j] = static_cast<float>(rules.turn[i][j].raw()) / Q14::kOne;
      result.step[i][j] = static_cast<float>(rules.step[i][j].raw()) / Q14::kOne;
    }
  }
  return result;
}

}  // namespace whisker::images
