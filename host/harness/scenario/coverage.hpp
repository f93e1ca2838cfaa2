/// Walls and ground that the cones of the three beams cover. docs/robots.md explains both rules.
#pragma once

#include "firmware/params.hpp"
#include "host/harness/scenario/sensor.hpp"

namespace whisker {

/// deg, added to the incidence that the geometry needs.
constexpr double kIncidenceMargin = 5;

/// deg. The direction, from straight ahead, of the outer edge of the left or the right cone. A cone that is
/// believed to be wider than it is at the distance up to which readings clear ground counts with its true
/// width there.
double outer_edge_deg(const Params& params, const Sensor& sensor, bool left);
/// deg. The smallest incidence up to which sensors must see flat walls so that no wall ahead is invisible:
/// the most that a direction between -90 and 90 degrees lies beside every cone.
double needed_incidence_deg(const Params& params, const Sensor& sensor);
/// Whether a straight wall whose normal points `normal_deg` to the left of straight ahead gives an echo
/// within this incidence, nearer than readings clear ground and not too near, where the body must begin to
/// brake.
bool wall_in_time(const Params& params, const Sensor& sensor, double normal_deg, double incidence_deg);
/// deg. The incidence up to which the sensors see flat walls: the smaller of the robot's and the sensor's.
double seen_incidence_deg(const Params& params, const Sensor& sensor);

/// m. The way from the apex of a beam along its axis to the rim of the body.
double rim_ahead_m(const Params& params, int beam);

/// A strip of ground beside a straight course, m from the course.
struct Strip {
  double inner_m = 0;
  double outer_m = 0;
  bool left = true;
  double width() const { return outer_m - inner_m; }
};

/// m. The stopping distance from full speed, at most the path that the planner checks ahead.
double seen_ahead_m(const Params& params);
/// The widest strip, within the ground that the guard keeps clear, that no cone sees while it lies within the
/// local grid and farther ahead of the body than seen_ahead_m(). Width 0: there is none. Resolution: 1/400 of
/// the radius.
Strip unseen_strip(const Params& params, const Sensor& sensor);
/// The strip is wider than the margin of the guard.
bool hides_obstacles(const Strip& strip, const Params& params);

}  // namespace whisker
