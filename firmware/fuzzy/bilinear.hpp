/// The look-up engine: bilinear interpolation in a table of nodes.
#pragma once

#include "firmware/fuzzy/packed_bilinear.hpp"
#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// Nodes are 2^kDistanceShift apart in D and 2^kBiasShift apart in R (raw Q7), from outer centre to outer
/// centre; inputs outside are limited to that range. The four weights of a look-up sum to a power of two, and
/// results are rounded to nearest, ties of turn toward zero, ties of step up. So results stay within the
/// values of the cell's four nodes, and a table mirrored in R (turn negated, step kept) gives exactly
/// mirrored results.
template <int kDistanceShift, int kBiasShift>
class BilinearGrid {
 public:
  static_assert(kDistanceSpan % (1 << kDistanceShift) == 0 && kBiasSpan % (1 << kBiasShift) == 0);
  static_assert(kDistanceSpan < 2048 && kBiasSpan < 2048, "place() divides with 11 bits to spare");
  static_assert(kDistanceShift + kBiasShift <= 14, "the sums of an interpolation are formed in 32 bits");
  static constexpr int16_t kDistanceSpacing = 1 << kDistanceShift;
  static constexpr int16_t kBiasSpacing = 1 << kBiasShift;
  static constexpr uint8_t kDistanceNodes = kDistanceSpan / kDistanceSpacing + 1;
  static constexpr uint8_t kBiasNodes = kBiasSpan / kBiasSpacing + 1;

  struct alignas(int) Node {
    int16_t turn;  ///< raw Q14
    int16_t step;  ///< raw Q14
  };
  struct Table {
    Node node[kDistanceNodes][kBiasNodes];
  };

  /// The table must outlive the engine. A change of the table takes effect in the next response.
  explicit constexpr BilinearGrid(const Table& table) noexcept : table_(&table) {}
  BilinearGrid(const Table&&) = delete;

  Response operator()(Inputs in) const noexcept {
#ifdef WHISKER_PACKED_BILINEAR
    if constexpr (kDistanceShift == kBiasShift) {
      return packed::look_up<kBiasShift, kBiasNodes>(table_->node, in);
    }
#endif
    const Place d = place<kDistanceShift, kDistanceLow, kDistanceSpan>(in.distance.raw());
    const Place r = place<kBiasShift, kBiasLow, kBiasSpan>(in.bias.raw());
    const Node* const near = &table_->node[d.cell][r.cell];
    const Node* const far = near + kBiasNodes;
    const int32_t w3 = static_cast<int32_t>(d.offset * r.offset);
    const int32_t w2 = static_cast<int32_t>(d.offset << kBiasShift) - w3;
    const int32_t w1 = static_cast<int32_t>(r.offset << kDistanceShift) - w3;
    const int32_t w0 = kWhole - w1 - w2 - w3;
    const int32_t turn = w0 * near[0].turn + w1 * near[1].turn + w2 * far[0].turn + w3 * far[1].turn;
    const int32_t step = w0 * near[0].step + w1 * near[1].step + w2 * far[0].step + w3 * far[1].step;
    // A mirrored turn has the opposite sum, a mirrored step the same sum, so only turn rounds by sign.
    const uint32_t turn_up = static_cast<uint32_t>(turn + (kWhole / 2 - 1));
    const uint32_t step_up = static_cast<uint32_t>(step + kWhole / 2);
    return {quotient(turn_up + (turn_up >> 31)),
            quotient(step_up),
            {static_cast<uint8_t>(d.cell), static_cast<uint8_t>(r.cell)}};
  }

 private:
  static constexpr int kWholeBits = kDistanceShift + kBiasShift;
  static constexpr int32_t kWhole = INT32_C(1) << kWholeBits;

  struct Place {
    uint32_t cell;
    uint32_t offset;
  };

  /// A node belongs to the cell below it, so that the last node has a cell; node 0 belongs to cell 0.
  template <int kShift, int16_t kLow, int16_t kSpan>
  [[gnu::always_inline]] static Place place(int16_t input) noexcept {
    const int32_t above_low = int32_t{input} - kLow;
    const int32_t at_least_low = above_low < 0 ? 0 : above_low;
    const uint32_t x = static_cast<uint32_t>(at_least_low > kSpan ? kSpan : at_least_low);
    // floor(x / 2^kShift - x / 2^(kShift + 11)): a little less than x / 2^kShift, as x < 2^11.
    const uint32_t cell = (x * 2047U) >> (kShift + 11);
    return {cell, x - (cell << kShift)};
  }

  /// floor(sum / kWhole) of a sum in two's complement. It extracts the sixteen bits, so no signed value is
  /// shifted.
  [[gnu::always_inline]] static Q14 quotient(uint32_t sum) noexcept {
    const int32_t bits = static_cast<uint16_t>(sum >> kWholeBits);
    return Q14::from_raw(static_cast<int16_t>(bits <= INT16_MAX ? bits : bits - INT32_C(0x10000)));
  }

  const Table* table_;
};

/// The grid of the committed table; docs/rules.md has its error.
using Bilinear = BilinearGrid<5, 5>;

extern template class BilinearGrid<5, 5>;

}  // namespace whisker::fuzzy
