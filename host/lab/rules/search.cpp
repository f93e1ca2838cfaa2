#include "host/lab/rules/search.hpp"

#include <algorithm>
#include <limits>

namespace whisker::rules {
namespace {

/// Tables above this size serve no chip; it also bounds the memory of a search.
constexpr std::size_t kMostNodes = std::size_t{1} << 23;

using Grid = std::vector<GridAxis>;

std::size_t nodes_of(const Grid& grid) {
  std::size_t n = 1;
  for (const GridAxis& axis : grid) n *= static_cast<std::size_t>(axis.nodes());
  return n;
}

/// Every spacing of one axis, widest first.
std::vector<GridAxis> spacings(const Domain::Part& part, bool symmetric) {
  std::vector<GridAxis> all;
  for (int shift = kMostShifts; shift >= 0; --shift) {
    const GridAxis axis{part.from, part.to, shift};
    const std::int32_t span = part.to - part.from;
    if (shift > 0 && (1 << (shift - 1)) >= span) continue;
    if (symmetric && (span & ((1 << shift) - 1)) != 0) continue;
    all.push_back(axis);
  }
  return all;
}

/// By size, smallest first.
std::vector<Grid> grids(const Surface& surface, const std::vector<Symmetry>& symmetries) {
  std::vector<std::vector<GridAxis>> of_part;
  for (std::size_t p = 0; p < surface.domain.parts.size(); ++p) {
    const auto keeps = [p](const Symmetry& s) { return s.part == p && s.broken_by == 0; };
    of_part.push_back(
        spacings(surface.domain.parts[p], std::any_of(symmetries.begin(), symmetries.end(), keeps)));
  }
  std::vector<Grid> all;
  for (const GridAxis& a : of_part[0]) {
    if (of_part.size() == 1) all.push_back({a});
    for (std::size_t i = 0; of_part.size() > 1 && i < of_part[1].size(); ++i)
      if (a.shift + of_part[1][i].shift <= kMostShifts) all.push_back({a, of_part[1][i]});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Grid& a, const Grid& b) { return nodes_of(a) < nodes_of(b); });
  return all;
}

bool has_nodes(const Grid& grid, const std::vector<std::int32_t>& nodes) {
  if (grid.size() != nodes.size()) return false;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (grid[i].nodes() != nodes[i]) return false;
  return true;
}

/// Greatest error as a share of its output's span.
double worst(const std::vector<Error>& errors, const std::vector<double>& spans) {
  double most = 0;
  for (std::size_t o = 0; o < spans.size(); ++o)
    if (spans[o] > 0) most = std::max(most, errors[o].greatest / spans[o]);
  return most;
}

}  // namespace

std::optional<Found> search(const Surface& surface, const std::vector<OutputScale>& scales,
                            const std::vector<double>& spans, const std::vector<Symmetry>& symmetries,
                            const Demand& demand) {
  std::optional<Found> best;
  const double tolerance =
      demand.most_bytes || !demand.nodes.empty() ? std::numeric_limits<double>::max() : demand.tolerance;
  double limit = tolerance;
  for (const Grid& grid : grids(surface, symmetries)) {
    const std::size_t nodes = nodes_of(grid);
    if (nodes > kMostNodes) break;
    if (!demand.nodes.empty() && !has_nodes(grid, demand.nodes)) continue;
    if (demand.most_bytes && nodes * scales.size() * sizeof(std::int16_t) > *demand.most_bytes) break;
    // Without a size, the first size with a good grid decides; among its grids, the best.
    if (best && !demand.most_bytes && nodes > nodes_of(best->table.axes)) break;
    Found found{make_table(surface, grid, scales), {}};
    if (!measure(surface, found.table, spans, limit, found.errors)) continue;
    const double error = worst(found.errors, spans);
    if (best && error >= worst(best->errors, spans)) continue;
    best = std::move(found);
    limit = error;
  }
  return best;
}

}  // namespace whisker::rules
