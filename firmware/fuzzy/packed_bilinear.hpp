/// The look-up in ARM's packed 16-bit arithmetic (Cortex-M4, M7, M33): both inputs, and both weights of a
/// row, share one register. 40 instructions on a Cortex-M4; the results equal BilinearGrid's, bit for bit.
#pragma once

#if defined(__ARM_FEATURE_DSP) && defined(__ARM_FEATURE_SIMD32)
#define WHISKER_PACKED_BILINEAR 1

#include <arm_acle.h>

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy::packed {

/// Two values of 16 bits: D in the lower half, R in the upper half.
using Pair = uint32_t;

constexpr Pair pair(int32_t distance, int32_t bias) noexcept {
  return static_cast<uint16_t>(distance) | static_cast<uint32_t>(static_cast<uint16_t>(bias)) << 16;
}

constexpr int16x2_t signed_pair(int32_t distance, int32_t bias) noexcept {
  return static_cast<int16x2_t>(pair(distance, bias));
}

/// {upper half of `below`, upper half of `above`}
[[gnu::always_inline]] inline Pair uppers(Pair below, Pair above) noexcept {
  Pair out;
  asm("pkhtb %0, %1, %2, asr #16" : "=r"(out) : "r"(above), "r"(below));
  return out;
}

/// {lower half of `below`, lower half of above / 2^kShift}
template <int kShift>
[[gnu::always_inline]] inline Pair lowers(int32_t below, int32_t above) noexcept {
  Pair out;
  asm("pkhbt %0, %1, %2, lsl %3" : "=r"(out) : "r"(below), "r"(above), "i"(16 - kShift));
  return out;
}

/// `nodes` are those of BilinearGrid, 2^kShift apart in either input, kRowNodes per row, with four bytes each
/// (turn and step), aligned to four bytes.
template <int kShift, int kRowNodes>
Response look_up(const void* nodes, Inputs in) noexcept {
  constexpr int32_t kTop = 0x7FFF;
  constexpr int16x2_t kToTop =
      signed_pair(kTop - (kDistanceLow + kDistanceSpan), kTop - (kBiasLow + kBiasSpan));
  constexpr uint32_t kCell = 0xFFFFU >> kShift;
  constexpr int32_t kOne = 1 << kShift;
  static_assert(sizeof(Inputs) == sizeof(Pair) && sizeof(Response) == 6);

  int16x2_t inputs;
  __builtin_memcpy(&inputs, &in, sizeof inputs);
  // Limited from above by saturation, then from below by its sign bit: the offset from the lowest centre.
  const Pair from_zero = static_cast<Pair>(__qadd16(inputs, kToTop)) ^ pair(0x8000, 0x8000);
  const Pair x = __uqsub16(from_zero, pair(0xFFFF - kDistanceSpan, 0xFFFF - kBiasSpan));
  const Pair cells = (__uqsub16(x, pair(1, 1)) >> kShift) & pair(kCell, kCell);
  Pair offsets = x - (cells << kShift);
  // Otherwise compilers compute them twice.
  asm("" : "+r"(offsets));

  const auto* node =
      static_cast<const int32_t*>(nodes) + __smuad(static_cast<int16x2_t>(cells), signed_pair(kRowNodes, 1));
  asm("" : "+r"(node));
  const int32_t near0 = node[0];
  const int32_t near1 = node[1];
  const int32_t far0 = node[kRowNodes];
  const int32_t far1 = node[kRowNodes + 1];

  const Pair across = uppers(pair(kOne, kOne) - offsets, offsets);
  const Pair both_far = across * static_cast<uint16_t>(offsets);
  const int32_t far = static_cast<int32_t>(both_far);
  const int32_t near = static_cast<int32_t>((across << kShift) - both_far);
  constexpr int kWholeBits = 2 * kShift;
  constexpr int32_t kHalf = 1 << (kWholeBits - 1);
  int32_t turn = __smlabb(near0, near, kHalf - 1);
  int32_t step = __smlatb(near0, near, kHalf);
  turn = __smlabt(near1, near, turn);
  step = __smlatt(near1, near, step);
  turn = __smlabb(far0, far, turn);
  step = __smlatb(far0, far, step);
  turn = __smlabt(far1, far, turn);
  step = __smlatt(far1, far, step);
  turn += static_cast<int32_t>(static_cast<uint32_t>(turn) >> 31);

  const Pair outputs = lowers<kWholeBits>(turn >> kWholeBits, step);
  const uint16_t cell = static_cast<uint16_t>(cells | cells >> 8);
  Response out;
  __builtin_memcpy(static_cast<void*>(&out), &outputs, sizeof outputs);
  __builtin_memcpy(&out.cell, &cell, sizeof cell);
  return out;
}

}  // namespace whisker::fuzzy::packed

#endif
