/// Boundary following for a body that must not touch: the bug algorithms' "follow the obstacle's boundary".
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/heading_search.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/transition.hpp"

namespace whisker::planning {

/// Drives along the wall by the beams while the guard lets it. Where that ends, or where the wall may have an
/// opening, the body stands, takes the first free heading counted from the wall, and goes on. If there is
/// none, it goes back on its own breadcrumbs. When to leave the boundary is the caller's rule.
class BoundaryFollower {
 public:
  enum class Phase : uint8_t {
    brake,    ///< comes to rest
    search,   ///< stands and takes the first free heading from the wall's side
    scan,     ///< turns a beam onto what is unknown in that way
    turn,     ///< turns to the heading chosen
    follow,   ///< drives along the obstacle's edge
    retreat,  ///< drives back the way it came
  };
  enum class Event : uint8_t { settled, unknown, scanned, free, none_free, facing, opening, stuck, back };

  static constexpr Transition<Phase, Event> kTransitions[] = {
      {Phase::brake, Event::settled, Phase::search},
      {Phase::search, Event::unknown, Phase::scan, Mode::looking, Why::unknown_ahead},
      {Phase::scan, Event::scanned, Phase::search, Mode::skirting},
      {Phase::search, Event::free, Phase::turn, Mode::skirting, Why::edge},
      {Phase::turn, Event::facing, Phase::follow, Mode::skirting},
      {Phase::follow, Event::opening, Phase::brake, Mode::idle, Why::opening},
      {Phase::follow, Event::stuck, Phase::brake},
      {Phase::search, Event::none_free, Phase::retreat, Mode::skirting, Why::way_back},
      {Phase::retreat, Event::back, Phase::follow, Mode::skirting, Why::edge},
      {Phase::retreat, Event::stuck, Phase::brake},
  };

  /// The behaviours must outlive it.
  explicit BoundaryFollower(Behaviours& behaviours) noexcept : behaviours_(behaviours) {}

  /// Forgets the way here.
  void reset(const View& view) noexcept { search_.reset(view.pose.at, behaviours_.params); }
  /// Once a tick, also while no boundary is followed.
  void move(const View& view) noexcept { search_.move(view.pose.at); }

  /// Each begins a boundary with the wall on this side:
  /// this heading is known to be free;
  void begin_along(Angle heading, Side wall) noexcept;
  /// the way along `blocked` is not free: takes the first free heading from there, away from the wall;
  void begin_beside(const View& view, Angle blocked, Side wall, Decision& decision) noexcept;
  /// the boundary goes on about `ahead`: takes the first free heading from the wall's side.
  void begin_at_wall(const View& view, Angle ahead, Side wall, Decision& decision) noexcept;

  /// Once a tick after that: manoeuvre, mode and reason. False: no way is free, not even the way back.
  bool step(const View& view, Decision& decision) noexcept;

  /// It drives along the edge: the only phase in which the boundary may be left.
  bool follows() const noexcept { return phase_ == Phase::follow; }
  /// What the body does now is due to what the guard holds back.
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
  bool searched_ = false;  // the heading chosen is the search's
  int8_t refusals_ = 0;    // in a row, from one place
  HeadingSearch search_;
  Angle heading_;           // the one chosen
  int32_t commit_mm_ = 0;   // travel until which it is kept
  int32_t opening_mm_ = 0;  // travel at which an opening was last looked for
};

}  // namespace whisker::planning
