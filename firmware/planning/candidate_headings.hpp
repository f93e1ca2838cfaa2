/// Candidate headings: which are free by the local grid, and where to scan to know more.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Headings around a turn, 7.5 degrees apart.
constexpr int32_t kCandidateHeadings = 48;

enum class Way : uint8_t {
  free,      ///< all of it is proved clear
  unknown,   ///< nothing known is in it, but not all of it was seen
  occupied,  ///< an echo came from it, or a scan of it from here was in vain
};

/// The way of this length from where the body stands, as wide as `reach` to both sides.
Way way(const View& view, Angle heading, Length length, Length reach) noexcept;

/// The turn that brings the nearest beam's axis onto the nearest unseen cell in that way, seen from
/// a body that heads `from`. False: there is no such cell, or the way is occupied.
bool turn_to_unseen(const View& view, Angle heading, Length length, Angle from, const Params& params,
                    Angle& turn) noexcept;

}  // namespace whisker::planning
