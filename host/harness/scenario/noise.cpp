#include "host/harness/scenario/noise.hpp"

#include <fmt/format.h>

#include "host/harness/scenario/text.hpp"

namespace whisker {

std::vector<std::string_view> noise_keys() {
  std::vector<std::string_view> keys;
  for (const NoiseKey& k : kNoiseKeys) keys.emplace_back(k.key);
  return keys;
}

void read_noise(const TableReader& table, Noise& noise) {
  for (const NoiseKey& k : kNoiseKeys) noise.*k.field = table.number_or(k.key, k.limits, noise.*k.field);
}

std::string noise_toml(const Noise& noise) {
  std::string out;
  for (const NoiseKey& k : kNoiseKeys) {
    if (noise.*k.field == 0) continue;
    out += fmt::format("{} = {}", k.key, toml_number(noise.*k.field));
    out += k.about[0] == '\0' ? "\n" : fmt::format("  # {}\n", k.about);
  }
  return out;
}

}  // namespace whisker
