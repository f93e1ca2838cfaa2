/// Classes of the robot's activity along its path, for pictures.
#pragma once

#include <array>
#include <vector>

#include "host/harness/run/record.hpp"
#include "host/harness/sim/geometry.hpp"

namespace whisker::report {

enum class Doing {
  free,     ///< driving towards the target
  table,    ///< steered by the response table
  probing,  ///< deflected because the planned step was not free
  danger,   ///< danger area: follow-side search or boundary following
};
constexpr int kDoings = 4;

/// The class of one tick. A danger counter above 0 is always `danger`; standing modes count as `free`.
Doing doing(const TickRecord& record) noexcept;

/// Counts for the reader.
struct TrackSummary {
  std::array<double, kDoings> metres{};  ///< driven, by Doing
  double total_m = 0;
  int danger_entries = 0;  ///< number of times that the danger counter left 0
  int longest_danger = 0;  ///< largest danger counter
  int looks = 0;           ///< ticks whose decision used a static scan
  int without_place = 0;   ///< records without a drawable position: omitted everywhere
};
TrackSummary summarise(const std::vector<TickRecord>& records);

/// A stretch of the path driven in one class; at least two different points.
struct Piece {
  Doing doing;
  std::vector<sim::Vec2> points;
};

/// The path as pieces that join end to start. Points within `tolerance_m` of the drawn line are dropped.
/// Doubles the tolerance until at most `max_points` remain, if the number of pieces allows it.
std::vector<Piece> pieces(const std::vector<TickRecord>& records, double tolerance_m, std::size_t max_points);

/// Ramer-Douglas-Peucker: keeps both ends; every dropped point lies within the tolerance of the kept line.
std::vector<sim::Vec2> simplified(const std::vector<sim::Vec2>& points, double tolerance_m);

/// Position of a mover: it starts at its centre towards the end of its path, then goes back and forth.
sim::Vec2 mover_position(const std::vector<sim::Vec2>& path, sim::Vec2 center, double driven_m);

}  // namespace whisker::report
