/// The local grid: which ground near the body is clear.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// Observation of one beam: nothing within its cone is nearer to the apex than `free`.
struct ConeObservation {
  Pose from;           ///< pose of the body at the time of the measurement
  Angle axis;          ///< direction of the beam from straight ahead
  Length free;         ///< free distance
  bool hit = false;    ///< an object lies at `free`
  bool aimed = false;  ///< from a static scan: cells that the beam covers and does not clear become tested
  Time taken{};
};

/// The free distance of the beam's last reading, and the pose at that time.
struct EarlierObservation {
  Pose from;
  Length free;
};

/// Cells in a path that are not clear.
struct Obstacles {
  int32_t unknown = 0;  ///< never cleared, and nothing else is known
  int32_t suspect = 0;  ///< near an echo, or a static scan did not clear it
  Vec nearest_unknown;  ///< the nearest unknown cell, from the body
};

/// A rolling grid of 32 x 32 cells around the body, aligned with the world. Each cell has one of four states,
/// and clear cells have an age.
///
/// A cell is clear only if it lies completely inside an empty beam sector. So clear ground is free ground if
/// the sensor reports the nearest object in its cone. Clear cells expire one to two spans of travel or
/// turning after they were last seen, or after the body last passed them, so that the way back stays open.
class LocalGrid {
 public:
  /// Shorter steps are below the resolution of the grid.
  static constexpr Length kShortestStep = micrometres(100);

  void configure(const Params& params) noexcept;
  /// Clears the ground under the body and the ring that no beam can clear from there (see blind_reach), which
  /// must be free; all else becomes unknown.
  void reset(const Pose& pose) noexcept;
  /// The same without the ring.
  void forget(const Pose& pose) noexcept;
  /// Moves the window with the body, ages the cells, clears the footprint.
  void move_to(const Pose& pose) noexcept;
  /// Clears the cells that both observations show empty, each from its own pose, so that a single false clear
  /// reading clears nothing. Without an earlier observation, only `observation` decides.
  void mark(const ConeObservation& observation, const EarlierObservation* before = nullptr) noexcept;
  /// An object in this beam between `observation.free` and `farthest` has moved there. Resets the cells that
  /// it can reach while the body stops, except those under the body. For a second, mark() clears no cell that
  /// near to an echo.
  void doubt(const ConeObservation& observation, Length farthest) noexcept;
  /// Something moved during the last second.
  bool doubting() const noexcept { return doubting_; }
  /// Lengths for which paths are checked.
  const Reach& reach() const noexcept { return reach_; }

  /// Cells within `radius` of the path whose centres lie ahead of its start, so that a body near an obstacle
  /// may drive along it or away from it. Stops at the row in which the limit of suspect cells is reached;
  /// later rows are not counted.
  Obstacles along(const Vec& from, Angle heading, Length length, Length radius,
                  int32_t enough = INT32_MAX) const noexcept;
  /// True if a step of this length brings the body nearer to a cell that is not clear, and then within
  /// `radius` of it. Cells abeam are ignored: passing them reduces the distance by less than the guard's
  /// margin. False below kShortestStep.
  bool approaches(const Vec& from, Angle heading, Length step, Length radius) const noexcept;
  /// The grid covers at most this distance from the body along each axis.
  Length half_window() const noexcept { return Length::from_raw(cell_um_ * (kCells / 2)); }
  /// The state of one cell, for display; false outside the window.
  bool is_clear(Vec at) const noexcept;
  /// True if all cells that this disc touches are inside the window and clear.
  bool all_clear(Vec centre, Length radius) const noexcept;

 private:
  struct Point {
    int32_t x = 0;
    int32_t y = 0;
  };
  Row clear_row(int row) const noexcept { return young_[slot(row)] | old_[slot(row)]; }
  int slot(int row) const noexcept { return (row_ + row) & (kCells - 1); }
  uint32_t shift() const noexcept { return static_cast<uint32_t>(column_) & (kCells - 1); }
  Row to_torus(Row window) const noexcept {
    return shift() == 0 ? window : (window << shift()) | (window >> (kCells - shift()));
  }
  Row to_window(Row torus) const noexcept {
    return shift() == 0 ? torus : (torus >> shift()) | (torus << (kCells - shift()));
  }
  int32_t units(Length l) const noexcept;
  int32_t units(int64_t um, int32_t most) const noexcept;
  Length length_of(int32_t units) const noexcept;
  Point local(Vec at) const noexcept;
  static bool in_window(Point p, int32_t reach) noexcept;
  void drop_rows(int first, int count) noexcept;
  void drop_columns(Row window) noexcept;
  void age(const Pose& pose) noexcept;
  void renew_around(Vec at) noexcept;
  void clear_around(Vec at, int32_t reach) noexcept;

  int32_t column_ = 0;  // of the window's corner, in world cells
  int32_t row_ = 0;
  Pose last_;
  Vec tested_at_;
  Length travel_;        // since the last ageing
  uint32_t turned_ = 0;  // the same, 2^-32 turn
  bool doubting_ = false;
  Time doubted_;
  Length offset_;
  Angle half_cone_;
  Length age_travel_;
  uint32_t age_turn_ = 0;
  Reach reach_;
  Length approach_;  // travel of a moving object while the body stops
  int32_t cell_um_ = 20000;
  int32_t footprint_ = 0;    // grid units
  int32_t placed_free_ = 0;  // assumed free when the body is placed; grid units
  int32_t ring_ = 0;         // the same: ring beside the body's path

  Row young_[kCells] = {};    // cleared since the last ageing step
  Row old_[kCells] = {};      // cleared before it
  Row suspect_[kCells] = {};  // near an echo
  Row tested_[kCells] = {};   // covered by a static scan from here and not cleared
};

}  // namespace whisker::perception
