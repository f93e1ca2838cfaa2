#include "host/harness/scenario/mounting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/harness/scenario/coverage.hpp"
#include "host/harness/scenario/param_list.hpp"

namespace whisker {
namespace {

constexpr const char* kBeamNames[] = {"left", "front", "right"};
constexpr double kRounding = 1e-6;  // deg, of an angle in the fixed-point unit

/// To a tenth of a degree, upwards.
double tenth_above(double deg) { return std::ceil(deg * 10 - kRounding) / 10; }

bool walls_may_be_invisible(const Params& p, const Sensor& s) {
  return seen_incidence_deg(p, s) + kRounding < needed_incidence_deg(p, s) + kIncidenceMargin;
}

/// deg. The normal of a wall ahead that shows itself too late, if sensors lose walls.
std::optional<double> late_wall(const Params& p, const Sensor& s) {
  const double seen = seen_incidence_deg(p, s);
  if (seen >= 90) return std::nullopt;
  for (int half_deg = -180; half_deg <= 180; ++half_deg) {
    if (!wall_in_time(p, s, half_deg / 2.0, seen + kRounding)) return half_deg / 2.0;
  }
  return std::nullopt;
}

/// Which side angle reaches the edge that this incidence needs.
std::string angle_that_sees_walls(const Params& p, const Sensor& s) {
  const double edge = 90 + kIncidenceMargin - seen_incidence_deg(p, s);
  const BeamParams(&own)[3] = p.rangefinders.beams;
  const bool shared = own[0].angle == Direction{} && own[2].angle == Direction{};
  std::string fits;
  for (const bool left : {true, false}) {
    const Mount m = mount(p.rangefinders, left ? 0 : 2);
    const double axis = std::fabs(m.axis.wrapped() * (180.0 / 2147483648.0));
    const double missing = edge - outer_edge_deg(p, s, left);
    if (missing <= 0 || (shared && !left)) continue;
    const double fit = tenth_above(axis + missing);
    fits += fits.empty() ? "" : " and ";
    fits += shared ? fmt::format("range_side_angle_deg >= {}", fit)
            : left ? fmt::format("range_left_angle_deg >= {}", fit)
                   : fmt::format("range_right_angle_deg <= -{}", fit);
  }
  return fits;
}

std::string invisible_walls(const Params& p, const Sensor& s) {
  const double needed = needed_incidence_deg(p, s), edge = 90 - needed, seen = seen_incidence_deg(p, s);
  if (std::min(outer_edge_deg(p, s, true), outer_edge_deg(p, s, false)) > edge + kRounding) {
    return fmt::format(
        "walls ahead may be invisible: some have a normal {:.1f} degrees beside the two cones next to it, "
        "and "
        "walls echo up to {:.1f} degrees, less than {:.1f} + {:.0f}; it would fit with a smaller gap between "
        "two cones (range_side_angle_deg, range_cone_deg), or with sensors that see walls up to {:.1f} "
        "degrees",
        needed, seen, needed, kIncidenceMargin, tenth_above(needed + kIncidenceMargin));
  }
  return fmt::format(
      "walls ahead may be invisible: the cones reach {:.1f} degrees outward (range_side_angle_deg + "
      "range_cone_deg / 2) and walls echo up to {:.1f} degrees: the sum {:.1f} is less than 90 + {:.0f}; it "
      "would fit with {}, or with sensors that see walls up to {:.1f} degrees",
      edge, seen, edge + seen, kIncidenceMargin, angle_that_sees_walls(p, s),
      tenth_above(90 + kIncidenceMargin - edge));
}

struct Step {
  const char* key;
  const char* bound;  ///< of what fits
  double by;          ///< SI unit
};
constexpr Step kSteps[] = {
    {"range_side_angle_deg", "<=", -0.5}, {"range_cone_deg", ">=", 0.5}, {"range_offset_m", "<=", -0.001}};

/// The smallest change in these steps that check() accepts and that leaves no warning; empty: none does.
std::string fit(const Params& params, const Sensor& sensor, const Step& step) {
  const std::vector<ParamEntry> list = param_list(params);
  const auto at = std::find_if(list.begin(), list.end(),
                               [&](const auto& e) { return step.key == std::string_view(e.key); });
  const double now = static_cast<double>(at->raw) * at->unit.denominator / at->unit.numerator;
  for (double to = std::floor(now / std::fabs(step.by)) * std::fabs(step.by) + step.by;; to += step.by) {
    const std::int64_t raw = to_raw(to, at->unit);
    if (raw < at->low || raw > at->high) return "";
    Params changed = params;
    set_param(changed, static_cast<std::size_t>(at - list.begin()), raw);
    if (check(changed) != ParamFault::none || walls_may_be_invisible(changed, sensor)) continue;
    if (!hides_obstacles(unseen_strip(changed, sensor), changed)) {
      return fmt::format("{} {} {}", step.key, step.bound, at->text_of(raw));
    }
  }
}

std::string unseen(const Params& p, const Sensor& s, const Strip& strip) {
  std::string fits;
  for (const Step& step : kSteps) {
    const std::string one = fit(p, s, step);
    if (!one.empty()) fits += (fits.empty() ? "" : " or ") + one;
  }
  return fmt::format(
      "the cones leave a gap: on a straight course, no cone sees the strip from {:.0f} to {:.0f} mm {} of it "
      "in time, {:.0f} mm ahead of the body: the guard slows down, an obstacle there stops it, and one that "
      "moves may hit the body; {}",
      strip.inner_m * 1e3, strip.outer_m * 1e3, strip.left ? "left" : "right", seen_ahead_m(p) * 1e3,
      fits.empty() ? "no single value of range_side_angle_deg, range_cone_deg or range_offset_m would fit"
                   : "it would fit with " + fits);
}

/// The share of what the robot believes that a sensor must see at least.
constexpr double kLeastSeen = 0.6;

}  // namespace

std::vector<std::string> contradictions(const Params& params, const Sensor& sensor) {
  const auto metres = [](Length x) { return x.raw() * 1e-6; };
  const std::string who =
      sensor.model.empty() ? "[sensor] says" : fmt::format("[sensor] model = \"{}\" says", sensor.model);
  const double farthest = metres(proving_range(params.rangefinders));  // that the robot believes of a beam
  double widest = 0;
  for (int i = 0; i < 3; ++i) {
    const double cone = mount(params.rangefinders, i).half_cone.raw() * (360.0 / 2147483648.0);
    widest = std::max(widest, cone);
  }
  std::vector<std::string> all;
  if (sensor.cone_deg && *sensor.cone_deg < kLeastSeen * widest) {
    all.push_back(fmt::format(
        "{} that a beam is {} degrees wide, and the robot believes {:.3g} degrees (range_cone_deg): it would "
        "take for seen what no beam has seen; {}",
        who, *sensor.cone_deg, widest,
        *sensor.cone_deg < Angle{5_deg}.raw() * (360.0 / 4294967296.0)
            ? "let each beam be the nearest reading of a sector of a scan, and give its width in both places"
            : "set range_cone_deg to what the sensor sees"));
  }
  if (sensor.max_range_m && *sensor.max_range_m < kLeastSeen * farthest) {
    all.push_back(fmt::format(
        "{} that a beam sees to {} m, and the robot believes {:.3g} m: farther ground would count "
        "as clear; set range_max_m or range_clear_m to what the sensor sees",
        who, *sensor.max_range_m, farthest));
  }
  return all;
}

std::vector<MountingWarning> mounting_warnings(const Params& params, const Sensor& sensor) {
  std::vector<MountingWarning> all;
  if (walls_may_be_invisible(params, sensor)) {
    all.push_back({"invisible_walls", invisible_walls(params, sensor)});
  } else if (const auto normal = late_wall(params, sensor)) {
    all.push_back(
        {"invisible_walls",
         fmt::format("walls ahead may be seen too late: one with a normal {:.1f} degrees beside the "
                     "course gives no echo between the minimum range and the range that clears "
                     "ground (range_max_m, range_clear_m) where the body must begin to brake, {:.0f} "
                     "mm before it",
                     *normal, seen_ahead_m(params) * 1e3)});
  }
  for (int i = 0; i < 3 && sensor.near_is == Near::farther; ++i) {
    const double hidden =
        sensor.min_range_m.value_or(params.rangefinders.min_range.raw() * 1e-6) - rim_ahead_m(params, i);
    if (hidden <= 1e-6) continue;
    all.push_back(
        {"near_reads_farther",
         fmt::format("what is nearer than the sensors' minimum range reads as farther, and that of the "
                     "{} beam ends {:.0f} mm beyond the rim of the body: an obstacle there may be "
                     "touched; mount the sensor so far behind the rim that nothing can be nearer",
                     kBeamNames[i], hidden * 1e3)});
    break;
  }
  const Strip strip = unseen_strip(params, sensor);
  if (hides_obstacles(strip, params)) all.push_back({"unseen_strip", unseen(params, sensor, strip)});
  return all;
}

}  // namespace whisker
