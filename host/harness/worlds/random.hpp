#pragma once

#include <cstdint>

namespace whisker::worlds {

/// SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, 2014). It gives the same
/// numbers on every machine, which the distributions of <random> do not guarantee.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  constexpr std::uint64_t bits() noexcept {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * (static_cast<double>(bits() >> 11) / 9007199254740992.0);
  }
  /// In [0, count). The bias is below count / 2^53.
  constexpr int index(int count) noexcept { return static_cast<int>(uniform(0, count)); }
  constexpr bool chance(double probability) noexcept { return uniform(0, 1) < probability; }

 private:
  std::uint64_t state_;
};

}  // namespace whisker::worlds
