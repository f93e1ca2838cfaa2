/// The spin in front of a simulated wall.
#pragma once

#include <cstdint>
#include <vector>

#include "host/calibration/sample.hpp"
#include "host/run/record.hpp"
#include "host/scenario/scenario.hpp"
#include "host/sim/spec.hpp"

namespace whisker::calibration {

/// Faces a wall across its way, at this distance from the centre, m.
Scenario wall_scenario(const Params& params, const Sensor& sensor, const Noise& noise, double wall_m);

/// m: 0.3, more for a large body or sensors that are blind near by, less for sensors of a short range.
double usual_distance_m(const Params& params, const Sensor& sensor);

/// believed: of the odometry and the spin. what: the robot as it is. along_m: see Spin. Headings count from
/// the start. The spin ends early if the body touches the wall. records: null, or receives a record of each
/// tick.
Sweep simulated_spin(const Scenario& scenario, const Params& believed, const sim::RobotSpec& what,
                     std::uint64_t seed, double along_m = 0, std::vector<TickRecord>* records = nullptr);

/// deg. What an ideal measurement at this distance would give.
struct Truth {
  double axis_deg = 0;
  double half_cone_deg = 0;
  double incidence_deg = 0;
  double edge_deg = 0;
};
Truth truth(const sim::RobotSpec& what, int beam, double wall_m);

}  // namespace whisker::calibration
