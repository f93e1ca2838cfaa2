/// Classifies candidate headings by the local grid, and finds where to scan next.
#pragma once

#include "firmware/params.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Headings around a turn, 7.5 degrees apart.
constexpr int32_t kCandidateHeadings = 48;

/// A search's share of this tick: one path at least, whatever the tick has done before.
class Share {
 public:
  explicit Share(const View& view) noexcept : work_(view.local_grid->work()) {}
  /// There is time to examine another path.
  bool more() noexcept {
    const bool is = first_ || work_.left() > 0;
    first_ = false;
    if (!is) work_.cut_short();
    return is;
  }

 private:
  const Work& work_;
  bool first_ = true;
};

enum class Way : uint8_t {
  free,      ///< all of it is clear
  unknown,   ///< nothing detected in it, but not all of it is clear
  occupied,  ///< an echo came from it, or a scan of it from here failed
};

/// State of the path of this length from the body's position, `reach` wide to both sides.
Way way(const View& view, Angle heading, Length length, Length reach) noexcept;

/// Unseen ground on a path.
struct Unseen {
  int32_t cells = 0;  ///< zero: none, or the path is occupied
  Angle turn;         ///< brings the axis of the nearest beam onto the nearest of these cells
};
/// That path as seen by a body with heading `from`.
Unseen unseen(const View& view, Angle heading, Length length, Angle from, const Params& params) noexcept;

}  // namespace whisker::planning
