/// The seam between what the robot knows and what it does next.
#pragma once

#include <stdint.h>

#include "firmware/fuzzy/engine.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/perception/echo.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/manoeuvre.hpp"
#include "firmware/planning/state.hpp"

namespace whisker::planning {

struct Goal {
  Vec at;
  Length tolerance;
  friend constexpr bool operator==(const Goal& a, const Goal& b) noexcept {
    return a.at.x == b.at.x && a.at.y == b.at.y && a.tolerance == b.tolerance;
  }
};

/// What a planner sees at a tick.
struct View {
  Pose pose{};          ///< the body's own estimate
  bool settled = true;  ///< the last manoeuvre is over and the body stands
  perception::Echoes
      static_scan{};  ///< consensus of the readings taken since the body stood; pending until then
  perception::Echoes
      moving_scan{};     ///< the same while it moves: the median of the last few readings of each beam
  bool sighted = false;  ///< a reading came at this tick
  const perception::LocalGrid* local_grid = nullptr;  ///< what is proved free nearby
  Speed forward{};                                    ///< of the body, by its wheels
  Speed turning{};                                    ///< of the rims, counter-clockwise positive
  Q14 granted{};       ///< part of the last cruise's forward speed that the guard let through
  Duration elapsed{};  ///< since the tick before
#ifndef WHISKER_SMALL
  const perception::ConeObservation* observations = nullptr;  ///< of the beams, taken in at this tick
  uint8_t proved = 0;                                         ///< a bit for each beam that has one
#endif
};

enum class Outcome : uint8_t { none, running, reached, unreachable, gave_up };

/// What it wants, and why.
struct Decision {
  Manoeuvre manoeuvre;  ///< ManoeuvreKind::keep: go on
  Mode mode = Mode::idle;
  Why why = Why::none;
  Outcome outcome = Outcome::none;
  uint8_t danger_count = 0;  ///< the thesis's t: positions since the target direction was last free
  bool looked = false;       ///< this tick's decision used the look
  fuzzy::Inputs inputs;      ///< of the response table, as last used
  fuzzy::Response response;
};

/// A planner is called once a tick, never blocks, and keeps its last mode, why and outcome until they
/// change. set_goal and cancel may come at any time; the next step() answers them.
class Planner {
 public:
  virtual void set_goal(const Goal& goal) noexcept = 0;
  /// The goal lies there by now, as the pose was corrected; the way to it goes on.
  virtual void move_goal(Vec at) noexcept = 0;
  virtual void cancel() noexcept = 0;
  virtual Decision step(const View& view) noexcept = 0;

 protected:
  ~Planner() = default;
};

}  // namespace whisker::planning
