#include "host/lab/play/table_of.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace whisker::play {
namespace {

using fuzzy::Bilinear;

constexpr std::size_t kNumbers = std::size_t{2} * Bilinear::kDistanceNodes * Bilinear::kBiasNodes;

bool is_answer(double x) { return std::abs(x) <= INT16_MAX && x == std::floor(x); }

}  // namespace

std::optional<Bilinear::Table> table_of(const std::vector<double>& list) {
  if (list.size() != kNumbers || !std::all_of(list.begin(), list.end(), is_answer)) return std::nullopt;
  Bilinear::Table table;
  const double* next = list.data();
  for (auto& row : table.node) {
    for (Bilinear::Node& node : row) {
      node.turn = static_cast<std::int16_t>(*next++);
      node.step = static_cast<std::int16_t>(*next++);
    }
  }
  return table;
}

}  // namespace whisker::play
