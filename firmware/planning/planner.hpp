/// The planner's interface: what it sees at a tick, and what it decides.
#pragma once

#include <stdint.h>

#include "firmware/fuzzy/variables.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/perception/percept.hpp"
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
struct View : perception::Percept {
  Pose pose{};                ///< the body's own estimate
  uint32_t travelled_um = 0;  ///< the length of its way so far, um modulo 2^32
  bool settled = true;        ///< the last manoeuvre is over and the body stands
  bool cut = false;           ///< the last manoeuvre was a drive, and the guard ended it before its length
  Speed forward{};            ///< of the body, by its wheels
  Speed turning{};            ///< of the rims, counter-clockwise positive
  Q14 granted{};              ///< part of the last forward speed asked for that the guard let through
  Duration elapsed{};         ///< since the tick before

  /// The guard let through only part of what was asked for.
  constexpr bool held_back() const noexcept { return granted < Q14::ratio(1, 1); }
};

enum class Outcome : uint8_t { none, running, reached, unreachable, gave_up };

/// What the planner asks for, and why.
struct Decision {
  Manoeuvre manoeuvre;  ///< ManoeuvreKind::keep: go on
  Mode mode = Mode::idle;
  Why why = Why::none;
  Outcome outcome = Outcome::none;
  uint8_t danger_count = 0;  ///< the thesis's t: positions since the target direction was last free
  bool looked = false;       ///< this tick's decision used a static scan
  fuzzy::Inputs inputs;      ///< of the response table, as last used
  fuzzy::Response response;
};

/// A planner is called once a tick, never blocks, and keeps its last mode, why and outcome until they
/// change. set_goal and cancel may come at any time; the next step() answers them.
class Planner {
 public:
  virtual void set_goal(const Goal& goal) noexcept = 0;
  /// The pose was corrected: the goal lies at `at` now. The mission goes on.
  virtual void move_goal(Vec at) noexcept = 0;
  virtual void cancel() noexcept = 0;
  virtual Decision step(const View& view) noexcept = 0;

 protected:
  ~Planner() = default;
};

}  // namespace whisker::planning
