/// The local grid: which ground near the body is clear.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/work.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/grid_scale.hpp"
#include "firmware/perception/lane.hpp"
#include "firmware/perception/observation.hpp"
#include "firmware/perception/raster.hpp"

namespace whisker::perception {

/// Cells in a path that are not clear.
struct Obstacles {
  int32_t unknown = 0;  ///< never cleared, and nothing else is known
  int32_t suspect = 0;  ///< near an echo, or a static scan did not clear it
  Vec nearest_unknown;  ///< the nearest unknown cell, from the body
};

/// How far a disc can go straight until it meets a suspect cell.
struct Ways {
  Length left;  ///< the farther of the ways at 30 and 60 degrees
  Length ahead;
  Length right;
  /// To the nearest such cell that is not behind, or up to 8 % less; 60 m if the window has none.
  Length nearest;
};

/// Cells that count as obstacles.
enum class Avoid : uint8_t {
  unclear,  ///< all that are not clear
  suspect,  ///< those of Obstacles::suspect
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
  /// Clears the ground under the body, to the radius of rim_sweep(); all else becomes unknown.
  void reset(const Pose& pose) noexcept;
  /// Moves the window with the body, ages the cells, clears the footprint.
  void move_to(const Pose& pose) noexcept;
  /// The apexes of two observations in the grid of this tick.
  struct Apexes {
    GridPoint now;
    GridPoint before;
  };
  Apexes apexes(const ConeObservation& observation, const EarlierObservation* before) const noexcept;
  /// Clears the cells that both observations show empty, each from its own pose, so that a single false clear
  /// reading clears nothing. Without an earlier observation, only `observation` decides.
  void mark(const ConeObservation& observation, const EarlierObservation* before, const Apexes& at) noexcept;
  void mark(const ConeObservation& observation, const EarlierObservation* before = nullptr) noexcept {
    mark(observation, before, apexes(observation, before));
  }
  /// Clears the cells that this reading and those of the same beam before it show empty together; for cells
  /// so near to the apex that no single reading covers them. `before` as in mark(). No effect if Reach::past
  /// is zero.
  void chain(const ConeObservation& observation, const EarlierObservation* before, const Apexes& at) noexcept;
  void chain(const ConeObservation& observation, const EarlierObservation* before = nullptr) noexcept {
    chain(observation, before, apexes(observation, before));
  }
  /// An object in this beam lies between these distances. If no unclear cell explains it, all cells that the
  /// cone touches from `nearest` to one cell beyond `farthest` become unknown, except those under the body: a
  /// sensor that loses walls seen at an angle may have cleared one of them. An unclear cell explains the echo
  /// if its centre lies at most one cell beyond `farthest`, or half a cell unless loses_only_grazed(). For
  /// sensors that lose walls, no cell on an open lane does.
  void revoke(const Beam& beam, Length nearest, Length farthest) noexcept;
  /// The same whatever explains the echo: for one that has just appeared or may be anywhere up to the minimum
  /// range, and while cells are clear that nobody has seen.
  void take_back(const Beam& beam, Length nearest, Length farthest) noexcept;
  /// The echo of a side beam has just appeared. If it is nearer than so many radii, the arc beside the cone,
  /// away from the front beam, becomes unknown up to one cell beyond `farthest`: what gives the echo may
  /// reach there, and the flank would meet it unseen.
  void revoke_beside(const ConeObservation& observation, Length farthest, int32_t radii) noexcept;
  /// An object in this beam between `observation.free` and `farthest` has moved there. Resets the cells that
  /// it can reach while the body stops, except those under the body. For a second, mark() clears no cell that
  /// near to an echo.
  void doubt(const ConeObservation& observation, Length farthest) noexcept;
  /// The cells that this disc touches are suspect, except those under the body. Holds until the next mark().
  void block(Vec centre, Length radius) noexcept;
  /// Someone says that nothing stands within this distance: clears the cells completely inside that no beam
  /// covers. The beams show nothing nearer than these distances. The cells that a beam covers, or touches
  /// from there on, stay as they are, and so do suspect ones.
  void vouch(Vec centre, Length radius, const Beam (&beams)[3], const Length (&free)[3]) noexcept;
  /// Opens a lane through a narrow gap: it begins here, and leads along this heading. On the lane, the ground
  /// is also known in cells that lie along it. It holds until the next one, or until a touch takes back
  /// ground; an echo takes back cells of both.
  void open_lane(const Pose& from) noexcept { lane_.open(from); }
  const Lane& lane() const noexcept { return lane_; }
  /// Something moved during the last second.
  bool doubting() const noexcept { return doubting_; }
  /// Lengths for which paths are checked.
  const Reach& reach() const noexcept { return reach_; }

  /// Cells within `radius` of the path whose centres lie ahead of its start, so that a body near an obstacle
  /// may drive along it or away from it. Stops at the row in which the limit of suspect cells is reached;
  /// later rows are not counted.
  Obstacles along(const Vec& from, Angle heading, Length length, Length radius,
                  int32_t enough = INT32_MAX) const noexcept;
  /// Obstacles::suspect of along() alone, at a quarter of the cost.
  int32_t suspects_along(const Vec& from, Angle heading, Length length, Length radius,
                         int32_t enough) const noexcept;
  /// The ways of a disc around `from` that touches cells as the body does with which the robot plans, each at
  /// most `horizon`. Cells abeam of a way are ignored. A mirrored grid has mirrored ways.
  Ways ways(const Vec& from, Angle course, Length horizon) const noexcept;
  /// Calls f with the centre of each cell that along() counts, from `from`.
  template <class F>
  void each_unclear(const Vec& from, Angle heading, Length length, Length radius, F&& f) const {
    const Point start = local(from);
    const Stadium stadium({start.x, start.y, heading, units(length), units(radius), abeam()});
    work_.add(kPathUnits);
    for (Rows rows = stadium.rows(); rows.more(); rows.next()) {
      work_.add(kPathRowUnits);
      Row open = to_window(~clear_row(rows.row())) & stadium.columns(rows.row());
      for (int32_t dx = kHalfCell - start.x; open != 0; open >>= 1, dx += kUnitsPerCell) {
        if ((open & 1U) != 0) f(Vec{length_of(dx), length_of(rows.offset(start.y))});
      }
    }
  }
  /// True if the body, after this way, is nearer to a cell that is not clear than before, and then within
  /// `radius` of it. Cells abeam are ignored: passing them reduces the distance by less than the guard's
  /// margin. Of a suspect one, the ground that the body itself would cover counts all the same. False below
  /// kShortestStep, and where the lane holds.
  bool approaches(const Vec& from, const Vec& way, Length radius,
                  Avoid avoid = Avoid::unclear) const noexcept;
  /// What the questions to the grid, and whoever works with it, have cost at this tick.
  const Work& work() const noexcept { return work_; }
  void begin_tick() noexcept { work_.begin(); }
  /// The grid covers at most this distance from the body along each axis.
  Length half_window() const noexcept { return Length::from_raw(scale_.cell_um() * (kCells / 2)); }
  /// The state of one cell, for display; false outside the window.
  bool is_clear(Vec at) const noexcept;
  /// True if all cells that this disc touches are inside the window and clear.
  bool all_clear(Vec centre, Length radius) const noexcept;

 private:
  // Units of Work.
  static constexpr int32_t kMarkUnits = 10, kMarkRowUnits = 4;
  static constexpr int32_t kLinkUnits = 10, kLinkRowUnits = 6;
  static constexpr int32_t kArcUnits = 6, kArcRowUnits = 4;
  static constexpr int32_t kPathUnits = 12, kPathRowUnits = 3;
  static constexpr int32_t kWayUnits = 4, kWayRowUnits = 2;
  static constexpr int32_t kDiscUnits = 3, kDiscRowUnits = 1;
  /// The cells that an echo between these distances may come from: takes them back, or tells whether all are
  /// clear.
  bool echo_arc(const Beam& beam, GridPoint apex, Length nearest, Length farthest, bool takes) noexcept;
  /// The cells of this row whose centres lie on the open lane, or at most half a cell beside it.
  Row on_lane(int row) const noexcept;
  bool leaves_window(const Beam& beam, GridPoint apex, Length farthest) const noexcept;
  static constexpr int32_t kAbeam = 80;  // a body that passes an obstacle may turn a little towards it
  // An obstacle at the guard's margin from the body comes nearer by less than that margin where the body
  // passes it, if it lies at most sqrt(2 radius margin) ahead.
  int32_t abeam() const noexcept { return passes_ < kAbeam ? passes_ : kAbeam; }
  static constexpr Length kReadingRounding = Length::from_raw(1000);
  using Point = GridPoint;
  Row clear(int slot) const noexcept { return young_[slot] | old_[slot]; }
  Row solid_at(int slot) const noexcept { return suspect_[slot] | tested(slot); }
  Row clear_row(int row) const noexcept { return clear(slot(row)); }
  Row solid_row(int row) const noexcept { return to_window(solid_at(slot(row))); }
  /// Suspect cells that are not clear.
  Row met(int slot) const noexcept { return solid_at(slot) & ~clear(slot); }
  void suspect(int slot, Row cells) noexcept {
    if (cells == 0) return;
    suspect_[slot] |= cells;
    solid_slots_ |= Row{1} << slot;
  }
  void test(int slot, Row cells) noexcept {
    tested_[slot] |= cells;
    solid_slots_ |= Row{1} << slot;
  }
  Row tested(int slot) const noexcept { return tested_[slot]; }
  void untest(int slot, Row cells) noexcept { tested_[slot] &= ~cells; }
  int slot(int row) const noexcept { return (row_ + row) & (kCells - 1); }
  uint32_t shift() const noexcept { return static_cast<uint32_t>(column_) & (kCells - 1); }
  Row to_torus(Row window) const noexcept {
    return shift() == 0 ? window : (window << shift()) | (window >> (kCells - shift()));
  }
  Row to_window(Row torus) const noexcept {
    return shift() == 0 ? torus : (torus >> shift()) | (torus << (kCells - shift()));
  }
  int32_t units(Length l) const noexcept { return scale_.units(l); }
  Length length_of(int32_t units) const noexcept;
  Point local(Vec at) const noexcept;
  static bool in_window(Point p, int32_t reach) noexcept;
  /// Of approaches(): a way that touches cells of this row, and of none before, that are not clear.
  struct Approach {
    const Vec& from;
    const Vec& way;
    int32_t reach;
    int row;
    Avoid avoid;
  };
  bool nears(const Approach& to) const noexcept;
  bool has_lane() const noexcept { return lane_.is_open(); }
  void close_lane() noexcept { lane_.close(); }
  void drop_rows(int first, int count) noexcept;
  void drop_columns(Row window) noexcept;
  void age(const Pose& pose) noexcept;
  void renew_around(Vec at) noexcept;
  void clear_around(Vec at, int32_t reach) noexcept;

  /// The readings of a beam one after another while its cone sweeps to one side.
  ///
  /// The trailing edge of the cone is the one behind which ground falls as it sweeps. A cell is swept while
  /// it has lain completely before some trailing edge, and no later reading can have missed a part of it. It
  /// is clear as soon as it also lies completely behind the leading edge (proof: docs/safety.md).
  struct Chain {
    bool linked = false;
    bool left = true;  // sweeps to the left: the left edge leads
    Beam last;         // the last reading
    Vec lead_from;     // a point of the leading edge, and its direction
    Angle lead;
    Length back;  // how far it has swept to the other side since
    Time taken;
    Row swept[kCells] = {};
  };
  /// Ground that no reading of a link may have seen lies behind this boundary.
  struct Boundary {
    Vec at;
    Facing facing;
  };
  struct Edge {
    Angle angle;
    Facing facing;
  };
  /// The edges of a cone that sweeps to one side.
  struct Sweep {
    Edge trail;
    Edge lead;
    Edge trail_before;
    Edge lead_before;
  };
  /// What an object that approaches may have come nearer since the reading.
  Length room_for(const ConeObservation& observation) const noexcept;
  bool follows(Chain& chain, const ConeObservation& observation) const noexcept;
  bool link(const Chain& chain, const Vec& from, const Edge& trail, Angle half_cone,
            Boundary& seen_ahead) const noexcept;
  bool sweep(Chain& chain, const ConeObservation& observation, const EarlierObservation* before,
             const Apexes& at, const Sweep& edges, const Boundary* seen_ahead) noexcept;

  Work work_;
  int32_t column_ = 0;  // of the window's corner, in world cells
  int32_t row_ = 0;
  Pose last_;
  Vec tested_at_;
  Length travel_;        // since the last ageing
  uint32_t turned_ = 0;  // the same, 2^-32 turn
  bool doubting_ = false;
  Time doubted_;
  Length age_travel_;
  uint32_t age_turn_ = 0;
  Reach reach_;
  Length approach_;  // travel of a moving object while the body stops
  GridScale scale_{20000};
  int32_t footprint_ = 0;  // grid units
  int16_t passes_ = 0;     // so far ahead may the centre of a cell with such an obstacle lie; grid units
  int16_t body_ = 0;       // what the body covers between two checked places; grid units
  int32_t ring_ = 0;       // ring beside the body's path; grid units
  int16_t meets_ = 0;      // radius of a disc that meets cells by their centres; grid units
  int16_t explains_ = 0;   // how far beyond an echo an unclear cell explains it; grid units

  Length clears_;       // how far readings clear ground
  Length place_error_;  // between two readings
  Length swept_;        // radius of rim_sweep()
  Length holds_;        // from this distance on, a cone holds a cell
  Chain chains_[3];
  void unlink() noexcept {
    for (Chain& chain : chains_) chain.linked = false;
  }

  Row young_[kCells] = {};    // cleared since the last ageing step
  Row old_[kCells] = {};      // cleared before it
  Row suspect_[kCells] = {};  // near an echo
  Row tested_[kCells] = {};   // covered by a static scan from here and not cleared
  // The slots with cells of either, one bit each; others, too, until ways() looks there.
  mutable Row solid_slots_ = 0;
  Lane lane_;
};

}  // namespace whisker::perception
