/// Echoes that come nearer until the body would touch what it sees.
#pragma once

#include "firmware/params.hpp"
#include "firmware/perception/observation.hpp"

namespace whisker::perception {

/// The echoes of a side beam that sees walls which the front beam loses.
///
/// The front beam has cleared what stands there, and the side beam's echo is explained by the part of the
/// wall that is known: abeam. So the wall ahead stays clear while the body slides towards it. But each point
/// and each wall that stands still comes nearer by the same share of the way, whatever explains its echo.
class ApproachWatch {
 public:
  void configure(const Params& params, const Mount& front, const Mount& own) noexcept;
  void reset() noexcept { any_ = false; }
  /// Takes in an echo. True: if it goes on coming nearer like this, the body will touch what it sees after
  /// the shortest warning.
  bool ends_at_body(const ConeObservation& echo) noexcept;

 private:
  Length touches_;  // the farthest point of the rim in the cone, and the guard's margin
  Length stops_;    // the way in which the body stops; zero: the front beam sees what this one sees
  Vec from_;        // the apex at the echo that the next ones are compared with
  Length free_;     // its distance
  Length nearer_;   // by so much once the body has stopped
  bool any_ = false;
};

}  // namespace whisker::perception
