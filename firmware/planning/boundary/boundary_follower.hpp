/// Follows the boundary of an obstacle, as in the bug algorithms, without contact.
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/heading_search.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/transition.hpp"

namespace whisker::planning {

/// Follows the wall by the beams while the guard permits it. When that ends, or when the wall may have an
/// opening, the body stops, takes the first free heading counted from the wall, and drives on. If no heading
/// is free, it retreats along its breadcrumbs. The caller decides when to leave the boundary.
class BoundaryFollower {
 public:
  enum class Phase : uint8_t {
    brake,    ///< comes to rest
    search,   ///< stands and takes the first free heading from the wall's side
    scan,     ///< turns a beam onto unknown ground on that path
    turn,     ///< turns to the heading chosen
    follow,   ///< drives along the obstacle's boundary
    retreat,  ///< drives back along its breadcrumbs
  };
  enum class Event : uint8_t { settled, unknown, scanned, free, none_free, facing, opening, stuck, back };

  static constexpr Transition<Phase, Event> kTransitions[] = {
      {Phase::brake, Event::settled, Phase::search},
      {Phase::search, Event::unknown, Phase::scan, Mode::looking, Why::unknown_ahead},
      {Phase::scan, Event::scanned, Phase::search, Mode::following},
      {Phase::search, Event::free, Phase::turn, Mode::following, Why::edge},
      {Phase::turn, Event::facing, Phase::follow, Mode::following},
      {Phase::follow, Event::opening, Phase::brake, Mode::idle, Why::opening},
      {Phase::follow, Event::stuck, Phase::brake},
      {Phase::search, Event::none_free, Phase::retreat, Mode::following, Why::way_back},
      {Phase::retreat, Event::back, Phase::follow, Mode::following, Why::edge},
      {Phase::retreat, Event::stuck, Phase::brake},
  };

  /// The behaviours must outlive it.
  explicit BoundaryFollower(Behaviours& behaviours) noexcept : behaviours_(behaviours) {}

  /// Resets the state of this boundary.
  void reset(const View& view) noexcept { search_.reset(view.pose.at, behaviours_.params); }
  /// Once per tick, also while no boundary is followed.
  void move(const View& view) noexcept { search_.move(view.pose.at); }

  /// Each begins a boundary with the wall on this side:
  /// this heading is known to be free;
  void begin_along(Angle heading, Side wall) noexcept;
  /// the path along `blocked` is not free: takes the first free heading from there, away from the wall;
  void begin_beside(const View& view, Angle blocked, Side wall, Decision& decision) noexcept;
  /// the boundary continues about `ahead`: takes the first free heading from the wall's side.
  void begin_at_wall(const View& view, Angle ahead, Side wall, Decision& decision) noexcept;

  /// Once per tick after that: manoeuvre, mode and reason. False: no path is free, not even the retreat.
  bool step(const View& view, Decision& decision) noexcept;

  /// Following the boundary: the only phase in which the boundary may be left.
  bool follows() const noexcept { return phase_ == Phase::follow; }
  /// The current behaviour results from the guard's intervention.
  bool yields(const View& view) const noexcept;

 private:
  void on(Event event, Decision& decision) noexcept;
  void start(Phase phase, Side wall) noexcept;
  void search(const View& view, Decision& decision) noexcept;
  void scan(const View& view, Decision& decision) noexcept;
  void turn(const View& view, Decision& decision) noexcept;
  void follow(const View& view, Decision& decision) noexcept;
  void search_from_wall(const View& view) noexcept;
  void search_on(const View& view, Decision& decision) noexcept;
  bool retreat(const View& view, Decision& decision) noexcept;
  bool opening(const View& view) noexcept;
  int32_t travel_mm() const noexcept { return behaviours_.progress.travel_mm(); }

  Behaviours& behaviours_;
  Phase phase_ = Phase::follow;
  Side wall_ = Side::left;
  bool searched_ = false;  // the search chose the heading
  int8_t refusals_ = 0;    // consecutive refusals at one place
  HeadingSearch search_;
  Angle heading_;           // the chosen heading
  int32_t commit_mm_ = 0;   // travel up to which it is kept
  int32_t opening_mm_ = 0;  // travel at the last search for an opening
};

}  // namespace whisker::planning
