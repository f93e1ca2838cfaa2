/// A local grid made by hand: as if a body turned once on the spot, sector by sector.
#pragma once

#include <cstdint>

#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::test {

constexpr Angle degrees(int deg) { return Angle::turns(deg, 360); }
constexpr double in_degrees(Angle a) { return a.wrapped() * 360.0 / 4294967296.0; }

/// Readings of three beams; 2000 mm is clear.
inline perception::Echoes echoes(int left_mm, int front_mm, int right_mm) {
  perception::Echoes e;
  const int mm[] = {left_mm, front_mm, right_mm};
  for (int i = 0; i < hal::kBeams; ++i) {
    e.beam[i] = {millimetres(mm[i]), mm[i] == 2000 ? perception::Validity::clear : perception::Validity::ok};
  }
  return e;
}

class Ground {
 public:
  explicit Ground(const Pose& pose = {}) : pose_(pose) {
    local_grid_.configure(params_);
    local_grid_.reset(pose);
  }

  /// Between these directions there is no obstacle nearer than this.
  Ground& free(int from_deg, int to_deg, Length reach = 500_mm) {
    return see(from_deg, to_deg, reach, false);
  }
  /// Between these directions there is an obstacle at this distance.
  Ground& echo(int from_deg, int to_deg, Length at) { return see(from_deg, to_deg, at, true); }
  /// A scan in this direction proves no more than this, and detects nothing.
  Ground& look_in_vain(int deg, Length reach) {
    mark(degrees(deg), reach, false, true);
    return *this;
  }
  void mark(Angle direction, Length reach, bool hit, bool aimed) {
    perception::ConeObservation observation;
    observation.beam = perception::beam_of(mount(params_.rangefinders, hal::kFront), {pose_.at, direction});
    observation.free = reach;
    observation.hit = hit;
    observation.aimed = aimed;
    local_grid_.mark(observation);
  }

  /// The view of the body at its position with this heading, with clear beams.
  planning::View view(Angle heading = {}) const {
    planning::View v;
    v.pose = {pose_.at, heading};
    v.static_scan = v.moving_scan = echoes(2000, 2000, 2000);
    v.sighted = true;
    v.local_grid = &local_grid_;
    v.granted = Q14::ratio(1, 1);
    return v;
  }
  const perception::LocalGrid& local_grid() const { return local_grid_; }
  const Params& params() const { return params_; }

 private:
  Ground& see(int from_deg, int to_deg, Length reach, bool hit) {
    // A cone proves no cell at its edge, so adjacent sectors overlap; an echo marks only the middle of its
    // cone.
    const int rim = hit || to_deg - from_deg >= 360 ? 0 : 6;
    for (int deg = from_deg + rim; deg <= to_deg - rim; ++deg) mark(degrees(deg), reach, hit, false);
    return *this;
  }

  const Params params_;
  const Pose pose_;
  perception::LocalGrid local_grid_;
};

}  // namespace whisker::test
