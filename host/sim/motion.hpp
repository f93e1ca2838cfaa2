/// The body's motion over one short step, and the exact moment of a contact in it.
#pragma once

#include "host/sim/geometry.hpp"
#include "host/sim/world.hpp"

namespace whisker::sim {

/// A circular arc (or a straight line, or a turn on the spot), travelled at a constant rate.
struct Arc {
  Pose from;
  double length = 0;  ///< m along the path of the body's centre; negative backwards
  double turn = 0;    ///< rad, counter-clockwise positive
};

/// The pose after this fraction of the arc, 0..1: the chord along the mean heading, exact.
Pose along(const Arc& arc, double fraction);

constexpr double kContactGap =
    1e-9;  ///< m: a larger gap is no contact, a gap of 0 is one, between them either
constexpr double kClearanceSlack = 1e-4;  ///< m: how far the smallest gap reported may exceed the true one

struct Sweep {
  double fraction = 1;  ///< of the arc that is free: 1 without a contact
  bool contact = false;
  double clearance = 0;        ///< m, at the end of the free part
  double least_clearance = 0;  ///< m, on the free part, or least_before if that is smaller
};

/// Follows the arc from time t for `duration`, s, until the body touches something. The gap cannot change
/// faster than the centre moves plus the fastest mover's speed; so a part of the arc is skipped only when the
/// gaps at its two ends prove that it holds no contact and no gap below the smallest by more than
/// kClearanceSlack. The free part ends within kContactGap (gap and path) of the contact.
/// clearance_before: at the start, m, > kContactGap. least_before: the smallest so far, <= clearance_before.
Sweep sweep(const WorldView& world, const Arc& arc, double t, double duration, double body_radius,
            double clearance_before, double least_before);

}  // namespace whisker::sim
