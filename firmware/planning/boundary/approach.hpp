/// Drives to the goal in free space: by the response table, or to the guide's way point.
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/course.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/boundary/target.hpp"
#include "firmware/planning/closest_approach.hpp"
#include "firmware/planning/global/global_planner.hpp"
#include "firmware/planning/transition.hpp"

namespace whisker::planning {

class Approach {
 public:
  enum class Phase : uint8_t {
    drive,  ///< towards the goal
    scan,   ///< turns a beam onto unknown ground on the path
    brake,  ///< comes to rest: the global planner replans
  };
  enum class Event : uint8_t { unknown, scanned, refused, settled };

  static constexpr Transition<Phase, Event> kTransitions[] = {
      {Phase::drive, Event::unknown, Phase::scan, Mode::looking, Why::unknown_ahead},
      {Phase::scan, Event::scanned, Phase::drive, Mode::going},
      {Phase::drive, Event::refused, Phase::brake},
      {Phase::brake, Event::settled, Phase::drive},
  };

  /// The references must outlive it, and so must the guide, if there is one.
  Approach(HeadingDeflection& law, GlobalPlanner* guide, Behaviours& behaviours) noexcept
      : law_(law), guide_(guide), behaviours_(behaviours) {}

  /// A new goal is set.
  void start(const View& view, const Goal& goal) noexcept;
  /// The goal moved to this place.
  void move_goal(Vec at) noexcept;
  /// Once per tick, also while a boundary is followed. `active`: step() is called next.
  void observe(const View& view, const Target& target, bool active, Decision& decision) noexcept;
  /// With the rest of a tick, also then.
  void ponder(const View& view) noexcept;

  /// Resets the course to straight at the goal.
  void begin() noexcept;
  /// Once per tick after that: manoeuvre, mode and reason. False: the path is blocked. `wall` is the side of
  /// the last obstacle; it is updated.
  bool step(const View& view, const Target& target, Side& wall, Decision& decision) noexcept;

  /// From here on, only a smaller distance counts as progress.
  void measure_anew(const View& view, Length distance) noexcept { closest_.set(view.pose.at, distance); }
  /// The least distance to the goal while no boundary was followed.
  Length closest() const noexcept { return closest_.distance(); }

  /// The same as in GlobalPlanner; false without a guide.
  bool knows_no_way() const noexcept { return guide_ != nullptr && guide_->knows_no_way(); }
  void pass() noexcept {
    if (guide_ != nullptr) guide_->pass();
  }
  bool doubt() noexcept { return guide_ != nullptr && guide_->doubt(); }

  /// The guide's way was blocked: the body brakes, and the guide finds another one.
  bool blocked() const noexcept { return phase_ == Phase::brake; }
  /// A global planner guides; without one, only the body's turning proves a closed loop.
  bool has_guide() const noexcept { return guide_ != nullptr; }
  /// The path is blocked because the global planner found none.
  bool refuted() const noexcept { return refuted_; }

  /// The current behaviour results from the guard's intervention.
  bool yields(const View& view, const Decision& decision) const noexcept;

 private:
  void on(Event event, Decision& decision) noexcept;
  bool drive(const View& view, const Target& target, Side& wall, Decision& decision) noexcept;
  bool scan(const View& view, Decision& decision) noexcept;
  bool brake(const View& view, Decision& decision) noexcept;
  /// The way is blocked. True: the guide shall find another one.
  bool detour(const View& view, Length distance, Decision& decision) noexcept;
  bool advised(const View& view, Length distance, Vec& to, Decision& decision) noexcept;

  HeadingDeflection& law_;
  Angle aim_;  // the direction of the goal or of the way point
  GlobalPlanner* guide_;
  Behaviours& behaviours_;
  Phase phase_ = Phase::drive;
  bool guided_ = false;  // drives to the guide's way point
  bool refuted_ = false;
  ClosestApproach closest_;
  Course course_;
};

}  // namespace whisker::planning
