/// Backs off when a bump switch is pressed.
#pragma once

#include <stdint.h>

#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/arrows.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

/// While it is active, it drives instead of the planner:
///
/// 1. stop: the wheels are commanded to stand, from the tick of the press on, until the counts stand still;
/// 2. back: along the places that the body has just passed, half its radius far. That ground is free,
///    whatever the beams say of it. If they end earlier and the switch is still pressed, straight back as the
///    guard grants;
/// 3. wait: until no switch is pressed. A switch that stays pressed for derived::stalled_after() is stuck.
///
/// Without a mission, the wheels stand while a switch is pressed, and nothing else happens.
class BumpReflex {
 public:
  struct Senses {
    uint8_t pressed = 0;   ///< hal::BumperReading::pressed
    bool mission = false;  ///< the planner drives to a goal
    bool still = false;    ///< the wheels counted nothing since the last tick
    Duration elapsed;      ///< since the last tick
  };

  /// The body was moved by other means.
  void reset() noexcept { *this = BumpReflex{}; }
  /// Once per tick. Returns the switches that were pressed now and not before in this reflex.
  uint8_t step(const Pose& pose, const Senses& senses, const Params& params) noexcept;

  bool active() const noexcept { return phase_ != Phase::watch; }
  /// The wheels must be commanded to stand at this tick.
  bool stops() const noexcept { return !backs() && (pressed_ || active()); }
  /// It drives back.
  bool backs() const noexcept { return phase_ == Phase::back; }
  /// It does so over ground that needs no check: the movement ends at the oldest of the places.
  bool retraces() const noexcept { return backs() && retraces_; }
  /// Only if backs().
  planning::VelocityRequest request(const Pose& pose, const Params& params) const noexcept;
  bool stuck(const Params& params) const noexcept {
    return phase_ == Phase::wait && pressed_ && derived::outlasts_a_stall(phase_for_, params);
  }

 private:
  enum class Phase : uint8_t { watch, stop, back, wait };
  static constexpr planning::Arrow<Phase> kArrows[] = {
      {Phase::watch, Phase::stop},
      {Phase::stop, Phase::back},
      {Phase::back, Phase::wait},
      {Phase::wait, Phase::watch},
  };
  static constexpr int8_t kPlaces = 9;

  void enter(Phase phase) noexcept;
  void remember(const Pose& pose, Length apart) noexcept;
  /// Drops the places that it has reached, or that are not behind it. False: none is left.
  bool has_way_back(const Pose& pose, Length apart) noexcept;
  Angle off_way_back(const Pose& pose) const noexcept;

  Phase phase_ = Phase::watch;
  bool pressed_ = false;
  bool retraces_ = false;
  uint8_t seen_ = 0;  // switches pressed in this reflex
  int8_t newest_ = 0;
  int8_t places_kept_ = 0;
  int8_t still_ticks_ = 0;
  Duration phase_for_;
  Vec pressed_at_;
  Angle heading_;        // at the newest place, or after a turn there
  Vec places_[kPlaces];  // a ring
};

}  // namespace whisker::safety
