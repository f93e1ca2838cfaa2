/// Mountings of three equal rangefinders that `whisker robot layout` compares.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/params.hpp"
#include "host/harness/scenario/coverage.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/lab/campaign/bounds.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

struct Layout {
  double side_angle_deg = 0;
  double offset_m = 0;
  Params robot;  ///< check() accepts them
};

struct LayoutGrid {
  std::vector<double> angles_deg, offsets_m;  ///< rising
  std::vector<Layout> layouts;                ///< by offset, then by angle
  Refusals refusals{};                        ///< of the other mountings, by the first violated relation
  std::uint64_t refused = 0;                  ///< their sum
};

constexpr double kFirstAngle = 25, kLastAngle = 65, kAngleStep = 5;  ///< deg
constexpr double kOffsets[] = {0, 0.5, 0.9};                         ///< body radii

/// The robot with every length that does not belong to its sensors multiplied by `size`, within the range of
/// the parameter. size > 0.
Params scaled(Params robot, double size);
/// The robot with three of these sensors: incidence, ranges, the cone at the distance up to which readings
/// clear ground, rate, latency, and time-outs and steps that fit them. The beams have no values of their own.
Params equipped(Params robot, const SensorModel& model);
/// The side angle at which the cones reach as far outward as the robot's incidence needs, deg: with the
/// margin of kIncidenceMargin, or without.
double rule_angle_deg(const Params& robot, bool with_margin);
/// Every mounting at these angles, deg; without them, at those of the grid and at the rule's angle with its
/// margin, rounded up to half a degree, if it is larger than kFirstAngle.
LayoutGrid layout_grid(const Params& robot, std::vector<double> angles_deg = {});

constexpr worlds::Kind kLayoutWorlds[] = {worlds::Kind::discs, worlds::Kind::u_trap, worlds::Kind::maze,
                                          worlds::Kind::rooms};
constexpr int kLayoutKinds = 4;
/// s for the reference robot; it scales as in fit_to().
constexpr double kLayoutTimeLimit = 600;

/// The world of this seed, the same for every layout. Throws what worlds::generate throws.
Scenario layout_scenario(const Layout& layout, const Sensor& sensor, worlds::Kind kind, std::uint64_t seed);

struct LayoutScore {
  Layout layout;
  double needed_incidence_deg = 0;  ///< the smallest L with side angle + cone / 2 + L >= 90
  double margin_deg = 0;            ///< what the sensors see beyond it; below 0: walls are invisible
  Strip unseen;                     ///< beside a straight course
  std::uint64_t missions = 0, reached = 0, contacts = 0;
  Estimate success, contact;  ///< shares of the missions
  /// Median of s_per_m over all missions, a mission that does not reach its goal counts as infinite; none:
  /// fewer than half reach it.
  std::optional<double> s_per_m;
  std::optional<double> world_s_per_m[kLayoutKinds];  ///< the same in each kind of kLayoutWorlds
};

/// rows: one campaign after another in the order of kLayoutWorlds, each of the same number of missions.
LayoutScore score(const Layout& layout, const Sensor& sensor, const std::vector<Row>& rows);

/// Best first: walls seen with kIncidenceMargin before walls seen, before others; then fewer contacts; then
/// more goals reached; then less time; then the smaller offset and angle.
void rank(std::vector<LayoutScore>& scores);

/// How rank() came to the first of them: one sentence. Not empty.
std::string reason(const std::vector<LayoutScore>& ranked);

}  // namespace whisker::campaign
