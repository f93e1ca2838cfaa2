/// Random numbers that are the same on every machine: xoshiro256++ (Blackman and Vigna), seeded by
/// SplitMix64.
#pragma once

#include <stdint.h>

namespace whisker::sim {

/// An independent stream of random numbers; the same (seed, stream) always gives the same numbers.
class Random {
 public:
  struct State {
    uint64_t word[4];
  };

  Random(uint64_t seed, uint32_t stream);
  /// Not all words zero.
  explicit Random(const State& state) : state_(state) {}

  uint64_t next();
  /// [0, 1), a multiple of 2^-53.
  double uniform();
  /// Mean 0, standard deviation 1, absolute value at most 8.6; always consumes two numbers of the stream.
  double normal();

 private:
  State state_;
};

}  // namespace whisker::sim
