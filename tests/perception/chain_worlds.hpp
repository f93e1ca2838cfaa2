/// Robots, walks and obstacles with which a chain of readings is most likely to miss something.
#pragma once

#include <vector>

#include "firmware/params.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/perception/cluttered.hpp"

namespace whisker::test {

inline sim::Vec2 vec(const Vec& v) { return {metres(v.x), metres(v.y)}; }
constexpr Angle tenths(int n) noexcept { return Angle::turns(n, 3600); }

/// A valid robot that needs chains.
Params draw_robot(worlds::Random& random);
/// The pose after a straight drive and then a turn, rad and m.
Pose after(const Pose& pose, double turned, double driven);
/// The poses of one reading after another.
std::vector<Pose> draw_walk(const Params& p, worlds::Random& random);
/// Adds an obstacle outside the discs that the body takes on this walk, or none; half of them so that only
/// one reading sees them, if `once`.
void add_obstacle(Cluttered& world, const Params& p, const std::vector<Pose>& walk, bool once,
                  worlds::Random& random);
/// Moves the world so that an obstacle lies in a corner of a cell, `slack` metres inside at least.
void align(Cluttered& world, std::vector<Pose>& walk, int32_t cell_um, double slack, worlds::Random& random);

}  // namespace whisker::test
