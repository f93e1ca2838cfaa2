#include "host/lab/hunt/robots.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "host/harness/scenario/coverage.hpp"
#include "host/harness/scenario/mounting.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/lab/campaign/random_robot.hpp"

namespace whisker::hunt {
namespace {

constexpr int kMostFamilyDraws = 60;
constexpr int kDrawsPerKey = 12;

double radius_m(const Params& p) { return p.body.radius.raw() * 1e-6; }
double size_of(const Params& p) { return campaign::size_of(p); }
double half(Dice& dice, double one, double other) { return dice.chance(0.5) ? one : other; }

void wide_cone(Dice& dice, Params& p) { set_si(p.rangefinders.cone, dice.uniform(25, 60)); }
void far_range(Dice& dice, Params& p) {
  set_si(p.rangefinders.max_range, std::clamp(dice.uniform(2, 10) * size_of(p), 0.2, 60.0));
}
void speeds(Dice& dice, Params& p, double slowest, double fastest) {
  set_si(p.wheels.max_speed, dice.log_uniform(slowest, fastest));
}

void lag(Dice& dice, Params& p) {
  set_si(p.wheels.motor_lag, dice.uniform(0.05, 0.5));
  set_si(p.wheels.max_acceleration, dice.log_uniform(0.5, 20));
  set_si(p.wheels.max_turn_rate, dice.log_uniform(1, 20));
  speeds(dice, p, 0.1, 1.2);
  far_range(dice, p);
}

void ticks(Dice& dice, Params& p) {
  const double period_s = half(dice, 0.05, dice.uniform(0.005, 0.05));
  set_si(p.safety.period, period_s);
  set_si(p.safety.max_gap, half(dice, 0.25, dice.uniform(2 * period_s + 0.002, 0.25)));
  set_si(p.wheels.motor_lag, half(dice, 0, dice.uniform(0, 0.02)));
  set_si(p.wheels.max_acceleration, dice.log_uniform(1, 20));
  set_si(p.wheels.max_turn_rate, dice.log_uniform(2, 20));
  set_si(p.conditioning.stale_after, 0.4);
  speeds(dice, p, 0.2, 3.2);
  far_range(dice, p);
  wide_cone(dice, p);
}

void cells(Dice& dice, Params& p) {
  wide_cone(dice, p);
  set_si(p.body.radius, dice.log_uniform(0.02, 1));
  set_si(p.boundary.guard_margin, half(dice, 0, dice.uniform(0, 0.006)));
}

void turns(Dice& dice, Params& p) {
  set_si(p.wheels.max_turn_rate, half(dice, 20, dice.uniform(6, 20)));
  set_si(p.wheels.max_acceleration, dice.log_uniform(0.5, 20));
  set_si(p.wheels.motor_lag, dice.uniform(0, 0.05));
  set_si(p.rangefinders.latency, dice.uniform(0, 0.2));
  p.rangefinders.rate_hz = static_cast<std::int32_t>(dice.log_uniform(5, 100));
  set_si(p.conditioning.stale_after, 0.8);
  speeds(dice, p, 0.3, 3.2);
  far_range(dice, p);
  wide_cone(dice, p);
}

void encoders(Dice& dice, Params& p) {
  p.wheels.counts_per_metre = static_cast<std::int32_t>(dice.log_uniform(100, 800));
  wide_cone(dice, p);
}

void brakes(Dice& dice, Params& p) {
  set_si(p.wheels.max_acceleration, dice.log_uniform(0.05, 1.5));
  set_si(p.wheels.max_turn_rate, dice.log_uniform(2, 20));
  speeds(dice, p, 0.1, 1);
  far_range(dice, p);
  if (dice.chance(0.5)) wide_cone(dice, p);
}

void mounts(Dice& dice, Params& p) {
  constexpr double kInner[] = {5, -20, -80}, kOuter[] = {80, 20, -5};
  for (int i = 0; i < 3; ++i) {
    BeamParams& beam = p.rangefinders.beams[i];
    const sim::Vec2 at = dice.direction() * (dice.uniform(0, 1) * radius_m(p));
    if (dice.chance(0.7)) set_si(beam.x, at.x);
    if (dice.chance(0.7)) set_si(beam.y, at.y);
    if (dice.chance(0.7)) set_si(beam.angle, dice.uniform(kInner[i], kOuter[i]));
    if (dice.chance(0.5)) set_si(beam.cone, dice.uniform(10, 60));
  }
}

void near(Dice& dice, Params& p) {
  set_si(p.rangefinders.min_range, std::min(1.0, dice.log_uniform(0.2, 4) * radius_m(p)));
  set_si(p.rangefinders.offset, half(dice, 0, dice.uniform(0, 1) * radius_m(p)));
  if (dice.chance(0.5)) wide_cone(dice, p);
}

/// The limit just above what docs/safety.md asks for at the ends and between two cones, or more.
void incidence(Dice& dice, Params& p) {
  const double side = half(dice, dice.uniform(25, 80), dice.uniform(30, 45)), cone = dice.uniform(10, 45);
  set_si(p.rangefinders.side_angle, side);
  set_si(p.rangefinders.cone, cone);
  const double spare = dice.chance(0.5) ? dice.uniform(0, 0.5) : dice.uniform(0, 20);
  set_si(p.rangefinders.incidence,
         std::clamp(std::max(95 - side - cone / 2, (side - cone) / 2 + 5) + spare, 5.0, 89.0));
  if (dice.chance(0.5)) set_si(p.rangefinders.min_range, dice.log_uniform(0.2, 2) * radius_m(p));
}

void readings(Dice& dice, Params& p) {
  p.rangefinders.rate_hz = dice.chance(0.3) ? 5 : static_cast<std::int32_t>(dice.log_uniform(5, 100));
  set_si(p.rangefinders.latency, half(dice, 0.2, dice.uniform(0, 0.2)));
  const double oldest_s = 1.0 / p.rangefinders.rate_hz + p.rangefinders.latency.raw() * 1e-3;
  set_si(p.conditioning.stale_after, std::clamp(oldest_s * dice.log_uniform(1.02, 4), 0.02, 2.0));
  p.conditioning.consensus = dice.chance(0.5) ? Consensus::median : Consensus::agreeing;
}

void bumper(Dice& dice, Params& p) {
  p.bumper.fitted = Fitted::yes;
  set_si(p.bumper.creep_speed, half(dice, 0, dice.uniform(0, 0.1)));
}

void gyro(Dice& dice, Params& p) {
  p.gyro.fitted = Fitted::yes;
  set_si(p.gyro.range,
         std::clamp(p.wheels.max_turn_rate.raw() * 1e-6 * dice.log_uniform(1.25, 8), 1.0, 40.0));
  p.gyro.rate_hz = static_cast<std::int32_t>(dice.log_uniform(20, 1000));
}

/// One of them alone, or several.
void errors(Dice& dice, Params& p) {
  const int only = dice.index(6);
  if (only == 0 || only > 2) set_si(p.pose_error.wheel_scale, dice.log_uniform(1e-5, 0.1));
  if (only == 1 || only > 3) set_si(p.pose_error.wheel_scale_common, dice.log_uniform(1e-5, 0.1));
  if (only == 2 || only > 3) set_si(p.pose_error.heading_drift, dice.log_uniform(0.01, 5));
  p.fix_jumps = dice.chance(0.5) ? JumpPolicy::refuse : JumpPolicy::accept;
}

struct FamilyEntry {
  const char* name;
  void (*draw)(Dice&, Params&);
};
/// In the order of the enumeration.
constexpr FamilyEntry kEntries[kFamilies] = {
    {"none", nullptr},        {"lag", lag},           {"ticks", ticks},
    {"cells", cells},         {"turns", turns},       {"encoders", encoders},
    {"brakes", brakes},       {"mounts", mounts},     {"near", near},
    {"incidence", incidence}, {"readings", readings}, {"bumper", bumper},
    {"gyro", gyro},           {"errors", errors}};

/// What the user says of the world or of the robot's own errors; the draw cannot make it true.
bool is_claim(std::string_view key) {
  return key == "straight_walls" || key == "wall_direction_deg" || key == "gyro_scale";
}

/// The places in param_list of what the core looks at.
std::vector<std::size_t> places_of_core(const std::vector<ParamEntry>& list) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (std::string_view(list[i].key) != "sonar") places.push_back(i);
  }
  return places;
}

Sensor as_declared(const Params& p) {
  Sensor sensor;
  sensor.incidence_deg = static_cast<double>(p.rangefinders.incidence.raw()) * 360 / 4294967296.0;
  return sensor;
}

/// Cheap; drivable() asks for the whole.
bool sees_enough(const Params& p) {
  const Sensor sensor = as_declared(p);
  return sensor.incidence_deg >= 90 ||
         seen_incidence_deg(p, sensor) >= needed_incidence_deg(p, sensor) + kIncidenceMargin;
}

bool fits(const Params& p) { return check(p) == ParamFault::none && sees_enough(p); }

std::int64_t clamped(const ParamEntry& e, double raw) {
  return static_cast<std::int64_t>(std::clamp(raw, static_cast<double>(e.low), static_cast<double>(e.high)));
}

std::int64_t log_value(Dice& dice, const ParamEntry& e) {
  const auto high = static_cast<double>(e.high);
  const double low = std::max({static_cast<double>(e.low), high * 1e-4, 1.0});
  const double size = low < high ? dice.log_uniform(low, high) : high;
  return clamped(e, e.low < 0 && dice.chance(0.5) ? -size : size);
}

std::int64_t near_value(Dice& dice, const ParamEntry& e, std::int64_t usual) {
  double base = static_cast<double>(dice.chance(0.5) ? e.raw : usual);
  if (base == 0) base = static_cast<double>(e.high - e.low) / 20 + 1;
  return clamped(e, base * sim::exponential(dice.uniform(-1.2, 1.2)));
}

std::int64_t draw_value(Dice& dice, const ParamEntry& e, std::int64_t usual) {
  if (e.word != nullptr) return dice.index(static_cast<int>(e.high) + 1);
  const double how = dice.uniform(0, 1);
  if (how < 0.15) return e.low;
  if (how < 0.3) return e.high;
  if (how < 0.6) return log_value(dice, e);
  if (how < 0.75) {
    return clamped(e, std::floor(dice.uniform(static_cast<double>(e.low), static_cast<double>(e.high) + 1)));
  }
  return near_value(dice, e, usual);
}

Params base(Dice& dice) {
  return dice.chance(0.5) ? Params{} : campaign::random_robot(dice.bits() >> 3).params;
}

/// The base itself if no draw of the family fits to it.
void draw_family(Dice& dice, DrawnRobot& robot) {
  robot.params = base(dice);
  const auto draw = kEntries[static_cast<int>(robot.family)].draw;
  for (int i = 0; draw != nullptr && i < kMostFamilyDraws; ++i) {
    if (i % 10 == 9) robot.params = base(dice);
    Params changed = robot.params;
    draw(dice, changed);
    ++robot.families.drawn;
    if (!fits(changed)) continue;
    ++robot.families.accepted;
    robot.params = changed;
    return;
  }
}

}  // namespace

const char* name(Family family) { return kEntries[static_cast<int>(family)].name; }

bool drivable(const Params& params) {
  if (!fits(params)) return false;
  if (params.rangefinders.incidence.raw() >= (90_deg).raw()) return true;
  for (const MountingWarning& warning : mounting_warnings(params, as_declared(params))) {
    if (warning.kind == std::string_view("invisible_walls")) return false;
  }
  return true;
}

DrawnRobot draw_robot(Dice& dice) {
  DrawnRobot robot;
  do {
    robot.family = static_cast<Family>(dice.index(kFamilies));
    draw_family(dice, robot);
    const int count = dice.chance(0.3)               ? 0
                      : robot.family == Family::none ? 2 + dice.index(22)
                                                     : dice.index(6);
    const Share keys = change_keys(dice, robot.params, count);
    robot.keys.drawn += keys.drawn;
    robot.keys.accepted += keys.accepted;
  } while (!drivable(robot.params));
  return robot;
}

Share change_keys(Dice& dice, Params& params, int count) {
  static const std::vector<ParamEntry> usual = param_list(Params{});
  static const std::vector<std::size_t> places = places_of_core(usual);
  Share share;
  for (int i = 0; i < count * kDrawsPerKey && share.accepted < static_cast<std::uint64_t>(count); ++i) {
    const std::size_t place = places[static_cast<std::size_t>(dice.index(static_cast<int>(places.size())))];
    if (is_claim(usual[place].key)) continue;
    Params changed = params;
    set_param(changed, place, draw_value(dice, param_list(params)[place], usual[place].raw));
    ++share.drawn;
    if (!fits(changed)) continue;
    ++share.accepted;
    params = changed;
  }
  return share;
}

}  // namespace whisker::hunt
