/// Motion of the body over one short step, and the exact time of a contact in it.
#pragma once

#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/world.hpp"

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
    1e-9;  ///< m: a larger gap is no contact, a gap of 0 is a contact, between them either
constexpr double kClearanceSlack = 1e-4;  ///< m: by which the reported smallest gap may exceed the true one

struct Sweep {
  double fraction = 1;  ///< free fraction of the arc: 1 without a contact
  bool contact = false;
  double clearance = 0;        ///< m, at the end of the free part
  double least_clearance = 0;  ///< m, on the free part, or least_before if that is smaller
};

/// Follows the arc from time t for `duration`, s, until the body touches something. The gap changes at most
/// as fast as the centre moves plus the speed of the fastest mover. So a part of the arc is skipped only if
/// the gaps at its two ends prove that it contains no contact and no gap below the smallest by more than
/// kClearanceSlack. The free part ends within kContactGap (gap and path) of the contact. clearance_before: at
/// the start, m, > kContactGap. least_before: the smallest so far, <= clearance_before.
Sweep sweep(const WorldView& world, const Arc& arc, double t, double duration, double body_radius,
            double clearance_before, double least_before);

}  // namespace whisker::sim
