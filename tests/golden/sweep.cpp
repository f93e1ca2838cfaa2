#include "firmware/fuzzy/bilinear.hpp"
#include "tests/golden/stream.hpp"

namespace whisker::golden {

Stream table_sweep() {
  using fuzzy::Bilinear;
  Stream stream{"table", {}, 0};
  const auto probe = [&](int distance, int bias) {
    append(stream.messages, Name::fuzzy,
           Probe{static_cast<std::int16_t>(distance), static_cast<std::int16_t>(bias)});
  };
  for (int d = 0; d < Bilinear::kDistanceNodes; ++d) {
    for (int r = 0; r < Bilinear::kBiasNodes; ++r) {
      const int distance = fuzzy::kDistanceLow + d * Bilinear::kDistanceSpacing;
      const int bias = fuzzy::kBiasLow + r * Bilinear::kBiasSpacing;
      probe(distance, bias);
      probe(distance + Bilinear::kDistanceSpacing / 2 - 3, bias + Bilinear::kBiasSpacing / 2 + 5);
    }
  }
  const int ends[] = {INT16_MIN,
                      INT16_MIN + 1,
                      fuzzy::kBiasLow - 1,
                      fuzzy::kBiasLow,
                      -1,
                      0,
                      1,
                      fuzzy::kDistanceLow,
                      fuzzy::kBiasHigh,
                      fuzzy::kBiasHigh + 1,
                      fuzzy::kDistanceHigh,
                      1153,
                      INT16_MAX - 1,
                      INT16_MAX};
  for (const int distance : ends) {
    for (const int bias : ends) probe(distance, bias);
  }
  return stream;
}

}  // namespace whisker::golden
