#include "host/lab/hunt/premise.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "firmware/can/param_server.hpp"
#include "host/harness/scenario/check.hpp"
#include "host/harness/scenario/limits.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/shapes.hpp"
#include "host/lab/hunt/events.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/robots.hpp"

namespace whisker::hunt {
namespace {

constexpr double kEverywhere_m = 1000;
constexpr double kNarrowest_m = 1e-4;
constexpr double kRounding_deg = 1e-4;

double metres(Length length) { return length.raw() * 1e-6; }
double degrees(Angle angle) { return static_cast<double>(angle.raw()) * 360 / 4294967296.0; }

struct Believed {
  double cone_deg = 0, min_range_m = kEverywhere_m, max_range_m = 0;
};

Believed believed(const RangefinderParams& r) {
  Believed all{0, metres(r.min_range), metres(r.max_range)};
  for (int i = 0; i < 3; ++i) all.cone_deg = std::max(all.cone_deg, degrees(beam_cone(r, i)));
  return all;
}

/// Ends and corners scatter, as the premise says.
void draw_better_sensor(Dice& dice, const RangefinderParams& r, Sensor& sensor) {
  const Believed all = believed(r);
  if (dice.chance(0.5)) sensor.incidence_deg = dice.uniform(sensor.incidence_deg, 90);
  if (dice.chance(0.3)) sensor.cone_deg = std::min(170.0, all.cone_deg * dice.uniform(1, 1.5));
  if (dice.chance(0.3)) sensor.min_range_m = all.min_range_m * dice.uniform(0, 1);
  if (dice.chance(0.3)) {
    sensor.max_range_m = std::min(60.0, all.max_range_m * dice.uniform(1, 1.5));
    sensor.far_is = Far::distance;
  }
}

void draw_fixes(Dice& dice, Noise& noise) {
  noise.fix_every_m = dice.log_uniform(0.05, 5);
  if (dice.chance(0.6)) noise.fix_sigma_m = dice.log_uniform(1e-4, 0.1);
  if (dice.chance(0.6)) noise.fix_sigma_deg = dice.log_uniform(0.01, 10);
}

bool is_beyond(sim::Vec2 p) { return std::max(std::fabs(p.x), std::fabs(p.y)) > kFarthest; }

bool all_within(const std::vector<sim::Vec2>& points) {
  return std::none_of(points.begin(), points.end(), is_beyond);
}

bool is_sound_polygon(const std::vector<sim::Vec2>& points) {
  return points.size() >= kFewestOfPolygon && all_within(points) && all_differ(points) && has_area(points) &&
         !crossing_edges(points);
}

bool is_sound_wall(const std::vector<sim::Vec2>& points) {
  return points.size() >= kFewestOfLine && all_within(points) && all_differ(points);
}

bool is_sound_disc(const sim::Disc& disc) { return disc.radius > 0 && !is_beyond(disc.center); }

bool fits_a_file(const Scenario& s) {
  return !is_beyond(s.start.at) && !is_beyond(s.goal.at) && tolerance_fault(s).empty() &&
         (!s.bounds || (is_sound(*s.bounds) && !is_beyond(s.bounds->min) && !is_beyond(s.bounds->max))) &&
         std::all_of(s.discs.begin(), s.discs.end(), is_sound_disc) &&
         std::all_of(s.walls.begin(), s.walls.end(), is_sound_wall) &&
         std::all_of(s.polygons.begin(), s.polygons.end(), is_sound_polygon);
}

bool senses_as_believed(const Params& p, const Sensor& sensor) {
  const Believed all = believed(p.rangefinders);
  return sensor.incidence_deg >= std::min(90.0, degrees(p.rangefinders.incidence)) &&
         sensor.corner_scatter_m >= metres(kScatterRange) &&
         sensor.cone_deg.value_or(all.cone_deg) >= all.cone_deg &&
         sensor.min_range_m.value_or(0) <= all.min_range_m &&
         sensor.max_range_m.value_or(all.max_range_m) >= all.max_range_m;
}

/// A parameter that changes on the way changes no wheel and no sensor.
bool describes_hardware(std::string_view key) {
  const std::string_view beginnings[] = {"range_", "wheel_", "body_radius", "motor_lag", "encoder_"};
  return std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](std::string_view begins) { return key.substr(0, begins.size()) == begins; });
}

bool is_of_the_same_body(const Params& p, const Params& first) {
  const std::vector<ParamEntry> now = param_list(p), then = param_list(first);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (describes_hardware(now[i].key) && now[i].raw != then[i].raw) return false;
  }
  return true;
}

}  // namespace

double free_at_start_m(const Params& params) { return metres(reach(params).guard) + kNarrowest_m; }

void draw_truth(Dice& dice, Scenario& s) {
  s.sensor = {};
  s.sensor.corner_scatter_m = dice.chance(0.5) ? metres(kScatterRange) : kEverywhere_m;
  s.sensor.incidence_deg = std::min(90.0, degrees(s.robot.rangefinders.incidence));
  if (dice.chance(0.2)) draw_better_sensor(dice, s.robot.rangefinders, s.sensor);
  s.noise = {};
  if (dice.chance(0.1)) s.noise.range_dropout = dice.log_uniform(0.001, 0.3);
  if (dice.chance(0.2)) draw_fixes(dice, s.noise);
}

void draw_wheels(Dice& dice, Scenario& s) {
  if (dice.chance(0.2)) s.noise.motor_lag_shorter = dice.chance(0.3) ? 1 : dice.uniform(0, 1);
}

bool senses_as_declared(const Scenario& s) {
  const RangefinderParams& r = s.robot.rangefinders;
  for (int i = 0; i < 3; ++i) {
    if (s.sensor.cone_deg.value_or(0) > degrees(beam_cone(r, i)) + kRounding_deg) return false;
  }
  return true;
}

bool is_held(const Scenario& s) {
  const std::vector<Params> robots = robots_of(s);
  return std::all_of(robots.begin(), robots.end(), can::outlasts_hold);
}

bool drives_alike_on_the_bus(const Scenario& s) {
  const double held_s = can::kCommandLate_ms * 1e-3 + s.robot.safety.period.raw() * 1e-3;
  const auto differs = [&](const Event& e) {
    return e.kind == EventKind::place || e.kind == EventKind::reset ||
           (e.kind == EventKind::frames_lost && e.for_s <= held_s);
  };
  return is_held(s) && std::none_of(s.events.begin(), s.events.end(), differs);
}

void keep_base_in_time(Case& c) {
  std::vector<Event>& events = c.scenario.events;
  const bool holds = !is_held(c.scenario);
  const auto drops = [&](const Event& e) {
    const bool restarts =
        e.kind == EventKind::restart || e.kind == EventKind::param || e.kind == EventKind::table;
    if (restarts) return c.gaps != 0;
    return e.kind == EventKind::frames_lost && (holds || c.gaps != 0);
  };
  events.erase(std::remove_if(events.begin(), events.end(), drops), events.end());
}

bool holds_premise(const Scenario& s) {
  const std::vector<Params> robots = robots_of(s);
  return std::all_of(robots.begin(), robots.end(),
                     [&](const Params& p) {
                       return drivable(p) && senses_as_believed(p, s.sensor) &&
                              is_of_the_same_body(p, s.robot);
                     }) &&
         fits_a_file(s) && nearest(s, s.start.at).distance_m >= free_at_start_m(s.robot);
}

}  // namespace whisker::hunt
