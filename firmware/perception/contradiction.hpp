/// Tells an object that moves from a wall that appears where sensors lose walls at some angles.
#pragma once

#include "firmware/perception/local_grid.hpp"

namespace whisker::perception {

/// Echoes of one beam from ground that earlier readings showed empty.
///
/// A wall at rest comes nearer by no more than the beam moves. Over a turn, the cone may meet another part of
/// it, so that only readings with nearly the same axis are compared.
class Contradiction {
 public:
  /// Takes in such an echo. True: it has come nearer since an earlier one than a wall at rest can.
  bool approaches(const ConeObservation& echo) noexcept;

 private:
  Vec apex_;
  Angle axis_;
  Length distance_;
  Time since_;
  bool any_ = false;
};

}  // namespace whisker::perception
