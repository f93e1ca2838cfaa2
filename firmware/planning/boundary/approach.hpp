/// The way to the goal in free space: by the response table, or where a global planner says.
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
    scan,   ///< turns a beam onto what is unknown in the way
    brake,  ///< comes to rest: the global planner plans anew
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
  /// The goal lies there by now.
  void move_goal(Vec at) noexcept;
  /// Once a tick, also while a boundary is followed.
  void observe(const View& view) noexcept;

  /// Straight at the goal again.
  void begin() noexcept;
  /// Once a tick after that: manoeuvre, mode and reason. False: the way is blocked. `wall` is the side that
  /// an obstacle was last on, and is kept up to date.
  bool step(const View& view, const Target& target, Side& wall, Decision& decision) noexcept;

  /// From here on, progress is what comes nearer than this.
  void measure_anew(const View& view, Length distance) noexcept { closest_.set(view.pose.at, distance); }
  /// The least distance to the goal while no boundary was followed.
  Length closest() const noexcept { return closest_.distance(); }

  /// As GlobalPlanner; false without one.
  bool knows_no_way() const noexcept { return guide_ != nullptr && guide_->knows_no_way(); }
  bool doubt() noexcept { return guide_ != nullptr && guide_->doubt(); }

  /// A global planner guides; without one, the turning of the body is the evidence for a closed loop.
  bool has_guide() const noexcept { return guide_ != nullptr; }
  /// The way is blocked because the global planner has found that there is none.
  bool refuted() const noexcept { return refuted_; }

  /// What the body does now is due to what the guard holds back.
  bool yields(const View& view, const Decision& decision) const noexcept;

 private:
  void on(Event event, Decision& decision) noexcept;
  bool drive(const View& view, const Target& target, Side& wall, Decision& decision) noexcept;
  bool scan(const View& view, Decision& decision) noexcept;
  bool brake(const View& view, Decision& decision) noexcept;
  bool advised(const View& view, Length distance, Vec& to, Decision& decision) noexcept;

  HeadingDeflection& law_;
  GlobalPlanner* guide_;
  Behaviours& behaviours_;
  Phase phase_ = Phase::drive;
  bool guided_ = false;  // drives where the guide says
  bool refuted_ = false;
  ClosestApproach closest_;
  Course course_;
};

}  // namespace whisker::planning
