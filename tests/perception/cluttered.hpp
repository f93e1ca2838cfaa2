/// Exact readings in a world of random obstacles.
#pragma once

#include <vector>

#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "host/harness/sim/geometry.hpp"
#include "host/harness/sim/world.hpp"

namespace whisker::test {

constexpr double metres(Length l) noexcept { return l.raw() * 1e-6; }

struct Cluttered {
  std::vector<sim::Disc> discs;
  std::vector<sim::Segment> segments;
  sim::WorldView view() const;
};

/// What this beam of a body with this pose measures, rounded to a millimetre.
perception::ConeObservation look(const Params& p, const Cluttered& world, const Pose& pose, int beam);

}  // namespace whisker::test
