#include "host/harness/sim/random.hpp"

#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {
namespace {

constexpr uint64_t kGolden = UINT64_C(0x9E3779B97F4A7C15);

uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  x = (x ^ (x >> 27)) * UINT64_C(0x94D049BB133111EB);
  return x ^ (x >> 31);
}

uint64_t rotated(uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

}  // namespace

// Mixes the seed before it adds the stream, because neighbouring seeds would otherwise share streams.
Random::Random(uint64_t seed, uint32_t stream) : state_{} {
  uint64_t x = mixed(mixed(seed + kGolden) + stream);
  for (uint64_t& word : state_.word) word = mixed(x += kGolden);
}

uint64_t Random::next() {
  uint64_t(&s)[4] = state_.word;
  const uint64_t result = rotated(s[0] + s[3], 23) + s[0];
  const uint64_t t = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= t;
  s[3] = rotated(s[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

// Box-Muller transform, because it always consumes the same number of random numbers.
double Random::normal() {
  const double radius = square_root(-2.0 * natural_log(1.0 - uniform()));
  const double angle = 2.0 * kPi * uniform();
  return radius * sin_cos(angle).cos;
}

}  // namespace whisker::sim
