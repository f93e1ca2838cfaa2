/// A table of nodes and its look-up in integers, as a chip computes it.
#pragma once

#include <cstdint>
#include <vector>

#include "host/lab/rules/surface.hpp"

namespace whisker::rules {

/// Sums of a look-up stay within 32 bits up to this many bits of both fractions together.
constexpr int kMostShifts = 15;

/// Nodes of one axis: at low, low + 2^shift, and so on. The last may lie beyond high.
struct GridAxis {
  std::int32_t low = 0;
  std::int32_t high = 1;
  int shift = 0;

  std::int32_t cells() const { return (high - low + (1 << shift) - 1) >> shift; }
  std::int32_t nodes() const { return cells() + 1; }
};

/// value = origin + raw / 2^bits (raw * 2^-bits if bits is negative).
struct OutputScale {
  double origin = 0;
  double per_unit = 1;
  bool odd = false;  ///< ties of the look-up go toward zero, not up: the table is antisymmetric
};

struct Table {
  std::vector<GridAxis> axes;  ///< one or two
  std::vector<OutputScale> scales;
  std::vector<std::int16_t> nodes;  ///< [row][column][output]

  std::size_t bytes() const { return nodes.size() * sizeof(std::int16_t); }
  std::int16_t node(std::int32_t row, std::int32_t column, std::size_t output) const;
};

/// To the nearest integer, ties away from zero; what is within 1e-7 of a tie is one. Limited to 16 bits,
/// without INT16_MIN.
std::int16_t nearest_raw(double raw);

/// The look-up of one output at raw inputs. Inputs beyond an axis are limited to it; a node belongs to the
/// cell below it, the first to the first cell; the result is rounded to nearest.
std::int16_t look_up(const Table& table, std::size_t output, const std::int32_t* raw);

/// Every node gets the exact answer, rounded to nearest, ties away from zero. A node beyond the range gets
/// the value that makes the last representable input exact.
Table make_table(const Surface& surface, const std::vector<GridAxis>& axes,
                 const std::vector<OutputScale>& scales);

/// One output of a scale: the finest power of two per unit with which its answers fit in 16 bits; an origin
/// other than 0 only if that resolves the output's span in fewer than 4096 steps.
OutputScale make_scale(const std::vector<double>& values, const Output& output);

}  // namespace whisker::rules
