/// All parameters in one struct: the unit is in the type, the default beside it, key and range are in
/// for_each_param, relations in check().
#pragma once

#include <stdint.h>

#include "firmware/math/angle.hpp"
#include "firmware/math/units.hpp"
#include "firmware/math/vec.hpp"

namespace whisker {

using namespace literals;

// Body, wheels and rangefinders describe the hardware and must be set (kMustSet has the keys); all others may
// be tuned.

struct BodyParams {
  Length radius = 90_mm;  ///< of the smallest disc around the middle of the axle that holds the robot
  Length margin = 30_mm;  ///< kept free around the body when a step is planned
  Length track = 140_mm;  ///< distance between the wheels' contact points
};

struct WheelParams {
  Speed max_speed = 300_mm_per_s;
  Acceleration max_acceleration = 1000_mm_per_s2;
  AngularRate max_turn_rate = 3000_mrad_per_s;
  Duration motor_lag = 50_ms;       ///< time constant from command to wheel speed
  int32_t counts_per_metre = 5000;  ///< encoder counts per metre of rim travel, mean of both wheels
  /// Rim travel per count of the right wheel / of the left wheel.
  Ratio ratio = millionths(1000000);
};

/// What one rangefinder has of its own. Zero stands for the value that all three share.
struct BeamParams {
  Length x;         ///< of its apex, ahead of the centre; x and y zero: RangefinderParams::offset
  Length y;         ///< the same to the left
  Direction angle;  ///< of its axis; zero: side_angle, 0 or -side_angle
  Angle cone;       ///< full width, at least 1 degree
};

enum class Fitted : int32_t { no, yes };

struct RangefinderParams {
  Angle side_angle = 30_deg;  ///< axis of the left beam from straight ahead; the right beam is mirrored
  Angle cone = 25_deg;        ///< full width
  Length min_range = 20_mm;
  Length max_range = 2000_mm;  ///< also the distance that a clear reading stands for
  Length offset = 0_mm;        ///< of each apex from the centre, along the axis of its beam
  int32_t rate_hz = 50;
  Duration latency = 20_ms;   ///< from the measurement to its arrival
  Length clear_range;         ///< readings mark no ground beyond it as free; zero: max_range
  Angle incidence = 90_deg;   ///< a flat wall seen beyond this angle from its normal may give no echo
  BeamParams beams[3];        ///< indexed by hal::Beam
  Fitted sonar = Fitted::no;  ///< for a board with drivers of both: three HC-SR04 are fitted
};

/// How several readings become one. The enumeration has four bytes like every parameter (params/words.cpp).
enum class Consensus : int32_t {
  agreeing,  ///< the last three readings agree (derived::kConsensusTolerance): their minimum
  median,    ///< the median of the last three readings
};

struct ConditioningParams {
  Consensus consensus = Consensus::agreeing;
  Duration stale_after = 100_ms;  ///< no new measurement for this long: stale
};

struct BoundaryParams {
  Length guard_margin = 4_mm;    ///< clearance around the body that the guard keeps at every tick
  Length length_budget = 400_m;  ///< travel after which a mission gives up; see also derived::most_steps
  Fitted bend = Fitted::yes;     ///< SA of the response table bends the course; also for the map planner
};

struct SafetyParams {
  Duration period = 10_ms;  ///< of tick(): the control period
  Duration max_gap;         ///< longest gap between two ticks; zero: see longest_gap
};

struct BumperParams {
  Fitted fitted = Fitted::no;  ///< bump switches are fitted: hal::Bumper
  Speed creep_speed;  ///< with a bumper: up to this speed also over ground that no beam has cleared; 0: never
};

struct GyroParams {
  Fitted fitted = Fitted::no;                          ///< a yaw-rate gyro is fitted: hal::Gyro
  int32_t rate_hz = 100;                               ///< samples a second by the chip's own clock
  AngularRate range = AngularRate::from_raw(8726646);  ///< rate of a sample of 32768: 500 deg/s
  Ratio scale = millionths(1000000);  ///< true rate / measured rate; includes the error of the chip's clock
};

/// Standard deviations of the errors that the pose rests on. Without any of the first three, they are
/// unknown and the pose has no bound. See Robot for what it changes.
struct PoseErrorParams {
  Ratio wheel_scale;                           ///< of each wheel's counts per metre, relative
  Ratio wheel_scale_common;                    ///< of both together
  Angle heading_drift;                         ///< of the wheels' heading after a metre
  Ratio gyro_scale = millionths(10000);        ///< relative
  Angle gyro_walk = Angle::turns(1, 900);      ///< angle random walk: after an hour
  Angle gyro_warm_up = Angle::turns(1, 3600);  ///< change of the bias in ten minutes, in a second
};

/// One of the first three is declared.
constexpr bool declares_errors(const PoseErrorParams& e) noexcept {
  return e.wheel_scale != Ratio{} || e.wheel_scale_common != Ratio{} || e.heading_drift != Angle{};
}

/// What becomes of a fix that jumps by more than its sigma allows. Either way it is counted.
enum class JumpPolicy : int32_t { accept, refuse };

/// What the user says of the walls. See localization::WallDirection for what it changes; of Robot only.
struct WallParams {
  Fitted straight = Fitted::no;  ///< long walls run in one direction, or at right angles to it
  Angle direction;               ///< this direction in the user's frame, counter-clockwise from x
};

/// Of whisker::Guard only.
struct GuardParams {
  Duration command_timeout = 250_ms;  ///< without a newer command for this long, it brakes
  Fitted nods = Fitted::yes;          ///< it turns a beam onto unseen ground that holds it
  Fitted assist = Fitted::yes;        ///< the response table bends and slows commands near obstacles
};

struct Params {
  BodyParams body;
  WheelParams wheels;
  RangefinderParams rangefinders;
  ConditioningParams conditioning;
  BoundaryParams boundary;
  SafetyParams safety;
  BumperParams bumper;
  GyroParams gyro;
  PoseErrorParams pose_error;
  JumpPolicy fix_jumps = JumpPolicy::accept;
  GuardParams guard;
  WallParams walls;
};

/// The violated relation between parameters; firmware/params/relations.hpp lists all relations.
enum class ParamFault : uint8_t;
const char* name(ParamFault fault) noexcept;

/// Calls f.number(key, field, min, max), f.count(key, field, min, max) or f.choice(key, field, names,
/// count) for every parameter; a choice between "false" and "true" is a boolean in a file. The suffix of
/// the key is the unit on the host: m, mps, mps2, radps, deg, s, hz. f.derived(key) stands for a parameter
/// that the robot derives (params/derived.hpp): a file may set it, without effect, and its index on the bus
/// stays free.
template <class P, class F>
constexpr void for_each_param(P& p, F&& f) {
  constexpr const char* kConsensus[] = {"agreeing", "median"};
  constexpr const char* kBoolean[] = {"false", "true"};
  constexpr const char* kJumps[] = {"accept", "refuse"};

  f.number("body_radius_m", p.body.radius, 20_mm, 1_m);
  f.number("body_margin_m", p.body.margin, 0_mm, 500_mm);
  f.number("wheel_track_m", p.body.track, 20_mm, 2_m);

  f.number("wheel_speed_max_mps", p.wheels.max_speed, 20_mm_per_s, 3200_mm_per_s);
  f.number("wheel_acceleration_max_mps2", p.wheels.max_acceleration, 50_mm_per_s2, 20000_mm_per_s2);
  f.number("turn_rate_max_radps", p.wheels.max_turn_rate, 100_mrad_per_s, 20000_mrad_per_s);
  f.number("motor_lag_s", p.wheels.motor_lag, 0_ms, 500_ms);
  f.count("encoder_counts_per_m", p.wheels.counts_per_metre, 100, 1000000);

  f.number("range_side_angle_deg", p.rangefinders.side_angle, 5_deg, 85_deg);
  f.number("range_cone_deg", p.rangefinders.cone, 1_deg, 90_deg);
  f.number("range_min_m", p.rangefinders.min_range, 0_mm, 1_m);
  f.number("range_max_m", p.rangefinders.max_range, 200_mm, 60_m);
  f.number("range_offset_m", p.rangefinders.offset, 0_mm, 1_m);
  f.count("range_rate_hz", p.rangefinders.rate_hz, 5, 100);
  f.number("range_latency_s", p.rangefinders.latency, 0_ms, 200_ms);

  f.choice("consensus", p.conditioning.consensus, kConsensus, 2);
  f.derived("consensus_reads");
  f.derived("consensus_tolerance_m");
  f.number("stale_after_s", p.conditioning.stale_after, 20_ms, 2000_ms);
  f.derived("stuck_turn_deg");

  f.derived("thesis_distance");
  f.derived("thesis_base_turn_deg");
  f.derived("thesis_base_step_m");
  f.derived("thesis_small_step_m");
  f.derived("thesis_delta_deg");
  f.derived("thesis_danger_range_m");
  f.derived("thesis_max_steps");

  f.derived("skirt_cell_m");
  f.derived("skirt_probe_m");
  f.number("skirt_shield_margin_m", p.boundary.guard_margin, 0_mm, 500_mm);
  f.derived("skirt_planning_margin_m");
  f.derived("skirt_age_travel_m");
  f.derived("skirt_age_turn_deg");
  f.derived("skirt_mover_speed_mps");

  f.derived("motion_settle_s");
  f.derived("turn_tolerance_deg");
  f.derived("drive_tolerance_m");

  f.number("control_period_s", p.safety.period, 5_ms, 50_ms);
  f.number("max_tick_gap_s", p.safety.max_gap, 0_ms, 250_ms);
  f.derived("lost_after_s");
  f.derived("wheels_stalled_after_s");
  f.derived("max_drive_refusals");

  // The index of a parameter on the CAN bus is its place in this list: append new ones.
  f.number("range_clear_m", p.rangefinders.clear_range, 0_mm, 60_m);
  f.number("length_budget_m", p.boundary.length_budget, 1_m, 2000_m);
  f.number("range_incidence_deg", p.rangefinders.incidence, 5_deg, 90_deg);

  constexpr Direction kOutermost = direction_of(85_deg);
  f.number("range_left_x_m", p.rangefinders.beams[0].x, -1_m, 1_m);
  f.number("range_left_y_m", p.rangefinders.beams[0].y, -1_m, 1_m);
  f.number("range_left_angle_deg", p.rangefinders.beams[0].angle, -kOutermost, kOutermost);
  f.number("range_left_cone_deg", p.rangefinders.beams[0].cone, Angle{}, 90_deg);
  f.derived("range_left_min_m");
  f.derived("range_left_max_m");
  f.number("range_front_x_m", p.rangefinders.beams[1].x, -1_m, 1_m);
  f.number("range_front_y_m", p.rangefinders.beams[1].y, -1_m, 1_m);
  f.number("range_front_angle_deg", p.rangefinders.beams[1].angle, -kOutermost, kOutermost);
  f.number("range_front_cone_deg", p.rangefinders.beams[1].cone, Angle{}, 90_deg);
  f.derived("range_front_min_m");
  f.derived("range_front_max_m");
  f.number("range_right_x_m", p.rangefinders.beams[2].x, -1_m, 1_m);
  f.number("range_right_y_m", p.rangefinders.beams[2].y, -1_m, 1_m);
  f.number("range_right_angle_deg", p.rangefinders.beams[2].angle, -kOutermost, kOutermost);
  f.number("range_right_cone_deg", p.rangefinders.beams[2].cone, Angle{}, 90_deg);
  f.derived("range_right_min_m");
  f.derived("range_right_max_m");

  f.choice("bumper", p.bumper.fitted, kBoolean, 2);
  f.number("creep_speed_mps", p.bumper.creep_speed, 0_mm_per_s, 100_mm_per_s);

  f.choice("gyro", p.gyro.fitted, kBoolean, 2);
  f.count("gyro_rate_hz", p.gyro.rate_hz, 20, 1000);
  f.number("gyro_range_radps", p.gyro.range, 1000_mrad_per_s, 40000_mrad_per_s);
  f.number("gyro_scale", p.gyro.scale, millionths(800000), millionths(1250000));

  f.number("wheel_scale_sigma", p.pose_error.wheel_scale, millionths(0), millionths(100000));
  f.number("wheel_scale_common_sigma", p.pose_error.wheel_scale_common, millionths(0), millionths(100000));
  f.number("heading_drift_deg_per_sqrt_m", p.pose_error.heading_drift, Angle{}, 5_deg);
  f.number("gyro_scale_sigma", p.pose_error.gyro_scale, millionths(0), millionths(100000));
  f.number("gyro_walk_deg_per_sqrt_h", p.pose_error.gyro_walk, Angle{}, 10_deg);
  f.number("gyro_warm_up_dps", p.pose_error.gyro_warm_up, Angle{}, 1_deg);
  f.choice("fix_jumps", p.fix_jumps, kJumps, 2);
  f.number("wheel_ratio", p.wheels.ratio, millionths(900000), millionths(1100000));
  f.number("command_timeout_s", p.guard.command_timeout, 20_ms, 2000_ms);
  f.choice("guard_nods", p.guard.nods, kBoolean, 2);
  f.choice("guard_assist", p.guard.assist, kBoolean, 2);
  f.choice("straight_walls", p.walls.straight, kBoolean, 2);
  f.number("wall_direction_deg", p.walls.direction, Angle{}, 90_deg);
  f.choice("bend_course", p.boundary.bend, kBoolean, 2);
  f.choice("sonar", p.rangefinders.sonar, kBoolean, 2);
}

/// The keys that describe the hardware, so that whoever builds a robot must set them: their defaults are
/// the reference robot's. All others may be tuned; their defaults fit any robot, or stand for what is not
/// fitted.
inline constexpr const char* kMustSet[] = {
    "body_radius_m",       "wheel_track_m",   "wheel_speed_max_mps",  "wheel_acceleration_max_mps2",
    "turn_rate_max_radps", "motor_lag_s",     "encoder_counts_per_m", "range_side_angle_deg",
    "range_cone_deg",      "range_min_m",     "range_max_m",          "range_offset_m",
    "range_rate_hz",       "range_latency_s", "range_incidence_deg",
};

/// A rangefinder on the body, in the body's frame: x ahead, y to the left.
struct Mount {
  Vec apex;
  Angle axis;
  Angle half_cone;
};
/// The beams of these rangefinders; 0 <= beam < 3.
constexpr Mount mount(const RangefinderParams& rangefinders, int beam) noexcept;
/// The axis of a beam, and its cone.
constexpr Angle beam_axis(const RangefinderParams& r, int beam) noexcept {
  return r.beams[beam].angle == Direction{} ? r.side_angle * (1 - beam) : angle_of(r.beams[beam].angle);
}
constexpr Angle beam_cone(const RangefinderParams& r, int beam) noexcept {
  return r.beams[beam].cone == Angle{} ? r.cone : r.beams[beam].cone;
}
/// The distance up to which readings mark ground as free.
constexpr Length proving_range(const RangefinderParams& r) noexcept {
  return r.clear_range == Length{} ? r.max_range : min(r.clear_range, r.max_range);
}
/// Walls may give no echo: see RangefinderParams::incidence.
constexpr bool loses_walls(const RangefinderParams& r) noexcept { return r.incidence.raw() < (90_deg).raw(); }
/// Where walls may give no echo, their ends and corners give one up to this distance from the apex of a
/// beam.
constexpr Length kScatterRange = 500_mm;
/// Side of a cell of the local grid: 2/9 of the radius.
constexpr Length grid_cell(const Params& params) noexcept;
/// A disc of this radius around the centre covers the cell, in 1/256 of a cell: 0.7072, rounded up.
constexpr int32_t kCellCover = 184;
/// Paths are checked within this number of cells from the centre of the local grid.
constexpr int32_t kHalfWindow = 15;
/// The radius of that disc.
constexpr Length cell_cover(const Params& params) noexcept;
/// The least clearance that the guard keeps. Between two checked places, 2/9 of the radius and 14.4 degrees
/// apart, the body's flank lies up to 1/162 of the radius outside both, and up to 1/143 beside their chord.
constexpr Length guard_slack(const Params& params) noexcept;
/// How the beams clear the ground at the rim of the body. Near its apex, a cone is narrower than a cell, so
/// that no single reading clears it: readings one after another must, while the body turns.
struct RimSweep {
  bool needed = false;  ///< for some cell at the rim, no single reading suffices
  Length radius;  ///< turning on the spot clears the ground beyond this distance from the centre; at least
                  ///< the body's radius. Ground between the two must be free when the robot is placed
  Angle step;     ///< of the turn between two readings one after the other but one, at most
  Angle past;     ///< see Reach; zero if not needed
};
/// Source of the formula: docs/safety.md.
constexpr RimSweep rim_sweep(const Params& params) noexcept;
/// The turn rate up to which the readings clear the ground at the rim, and which the parameters allow.
constexpr AngularRate turn_rate(const Params& params) noexcept;
/// How far the path is checked, ahead and beside.
struct Reach {
  Length guard;     ///< distance from the centre of the body within which cells must be clear at every tick
  Length planning;  ///< the same for a chosen heading
  Length probe;     ///< length of the checked path: 5/3 of the radius, or the reach of the local grid. Where
                    ///< walls may give no echo, it ends at kScatterRange from the front beam
  Angle past;  ///< a beam clears a cell at the rim while it turns from this angle before the cell to this
               ///< angle behind it; zero if a single reading does
};
/// Computes a sine and divisions, so perception::LocalGrid stores the result.
constexpr Reach reach(const Params& params) noexcept;
/// The longest accepted time between two ticks; a longer gap is Fault::clock_jump. The guard assumes it for
/// every movement: the body must be able to stop even if the next tick comes that late. By default 50 ms
/// more than the period, so that the robot survives 40 ms of bus silence.
constexpr Duration longest_gap(const Params& p) noexcept {
  if (p.safety.max_gap != Duration{}) return p.safety.max_gap;
  return p.safety.period + 50_ms;
}
/// Scales a distance for the reference body of 90 mm to this body.
Length for_body(const Params& p, Length reference) noexcept;

/// The first violated relation; ParamFault::none for a valid set. Usable in a static_assert. For all
/// violations, see for_each_relation in params/relations.hpp.
constexpr ParamFault check(const Params& params) noexcept;

}  // namespace whisker

// Definitions of the constexpr functions above.
#include "firmware/params/derived.hpp"
#include "firmware/params/relations.hpp"
