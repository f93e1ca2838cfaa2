/// What the beams have proved about the ground near the body: a rolling grid of cells.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// One beam's evidence: nothing lies within its cone nearer than `free` to the apex.
struct ConeObservation {
  Pose from;           ///< the body's, at the time of the measurement
  Angle axis;          ///< of the beam, from straight ahead
  Length free;         ///< proved empty
  bool hit = false;    ///< something lies at `free`
  bool aimed = false;  ///< from a look: what this beam covers and does not clear, no look from here will
  Time taken{};
};

/// What a beam had shown empty one reading before, and from where.
struct EarlierObservation {
  Pose from;
  Length free;
};

/// Cells that lie in the way.
struct Obstacles {
  int32_t unknown = 0;  ///< never cleared, and nothing more is known
  int32_t suspect = 0;  ///< near an echo, or looked at from here in vain
  Vec nearest_unknown;  ///< where the nearest unknown one is, from the body
};

/// The local grid: 32 x 32 world-aligned cells around the body, in three states and an age.
///
/// Clear cells age: each lives for one to two spans of travel or turning after it was last seen, or after the
/// body last went by it, so that the way back stays open.
///
/// A cell is *clear* only if it lies inside an empty beam sector as a whole, so that with a sensor that
/// reports the nearest thing in its cone clear ground is free ground.
class LocalGrid {
 public:
  /// Rounding decides what a shorter step comes nearer to.
  static constexpr Length kShortestStep = micrometres(100);

  void configure(const Params& params) noexcept;
  /// Nothing is known but the ground under the body, and the ring that no beam can prove from there (see
  /// blind_reach), which must be free.
  void reset(const Pose& pose) noexcept;
  /// The same without the ring.
  void forget(const Pose& pose) noexcept;
  /// The body is here now: moves the window along, ages the cells, clears the footprint.
  void move_to(const Pose& pose) noexcept;
  /// Clears the cells that both readings show empty, each from its own pose: one that wrongly says that
  /// nothing is there clears nothing. Without an earlier one, what the proof alone shows.
  void mark(const ConeObservation& observation, const EarlierObservation* before = nullptr) noexcept;
  /// What this beam sees between `proof.free` and `farthest` has moved there: takes back what was clear
  /// around it, as far as it may come while the body stops, but for the ground under the body. For a second,
  /// mark() clears nothing that near to an echo.
  void doubt(const ConeObservation& observation, Length farthest) noexcept;
  /// Something moved a moment ago.
  bool doubting() const noexcept { return doubting_; }
  /// As far as the parameters want ways to be judged.
  const Reach& reach() const noexcept { return reach_; }

  /// The cells that come within `radius` of the way and whose centres lie ahead of its beginning: a body that
  /// stands near something may move off along it or away from it.
  /// It stops at the row in which so many suspect ones are reached: what else lies there is not counted.
  Obstacles along(const Vec& from, Angle heading, Length length, Length radius,
                  int32_t enough = INT32_MAX) const noexcept;
  /// True if a step of this length brings the body nearer to a cell that is not clear and then within
  /// `radius` of it. Cells abeam do not count: to pass them brings it nearer by less than the guard's
  /// margin. False below kShortestStep.
  bool approaches(const Vec& from, Angle heading, Length step, Length radius) const noexcept;
  /// No further than this from the body, along each axis, anything is known.
  Length half_window() const noexcept { return Length::from_raw(cell_um_ * (kCells / 2)); }
  /// The state of one cell, for those who want to see the local grid; false outside the window.
  bool is_clear(Vec at) const noexcept;
  /// True if all cells that this disc touches are clear, none of them outside the window.
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

  Row young_[kCells] = {};    // cleared since the last ageing
  Row old_[kCells] = {};      // cleared before it
  Row suspect_[kCells] = {};  // near an echo
  Row tested_[kCells] = {};   // covered by a look from here and not cleared
  int32_t column_ = 0;        // of the window's corner, in cells of the world
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
  Length approach_;  // of something that moves, while the body stops
  int32_t cell_um_ = 20000;
  int32_t footprint_ = 0;    // grid units
  int32_t placed_free_ = 0;  // taken for free where the body is placed; grid units
  int32_t ring_ = 0;         // the same: of what lies beside the body's way
};

}  // namespace whisker::perception
