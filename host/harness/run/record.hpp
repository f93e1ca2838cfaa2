/// The result of a run: one record per control tick, and the verdict.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/fuzzy/variables.hpp"
#include "firmware/health.hpp"
#include "firmware/localization/pose_bound.hpp"
#include "firmware/planning/state.hpp"
#include "hal/types.hpp"
#include "host/harness/run/event_player.hpp"
#include "host/harness/run/guidance.hpp"
#include "host/harness/run/verdict.hpp"

namespace whisker {

struct TickRecord {
  double t_s = 0;
  double x_m = 0, y_m = 0, heading_rad = 0;  ///< true pose
  hal::RangeReadings ranges{};               ///< as measured, by hal::Beam
  double v_left_mps = 0, v_right_mps = 0;    ///< true wheel speeds
  planning::Mode mode = planning::Mode::idle;
  planning::Why why = planning::Why::none;
  std::uint8_t danger_count = 0;                         ///< the thesis's t
  bool looked = false;                                   ///< this tick's decision used a static scan
  std::int16_t d_q7 = 0, r_q7 = 0;                       ///< fuzzy inputs last used, 1/128
  std::int16_t sa_q14 = 0, sd_q14 = 0;                   ///< fuzzy outputs last used, 1/16384
  double bend_rad = 0;                                   ///< by which SA bends the course
  double pace_mps = 0;                                   ///< that SD sets; 0: it sets none
  fuzzy::Cell cell{};                                    ///< of the response table, last used
  hal::WheelSpeeds command{};                            ///< 0.1 mm/s
  double est_x_m = 0, est_y_m = 0, est_heading_rad = 0;  ///< the core's own estimate
  bool inside = true;  ///< false: the core is remote and its fuzzy values and estimate are unknown
  Guidance guide = Guidance::unknown;
  std::uint8_t pressed = 0;                      ///< bump switches, see hal::BumperReading
  double way_x_m = 0, way_y_m = 0;               ///< way point, in the frame of the estimate; 0 without one
  std::optional<localization::PoseSigma> sigma;  ///< of the estimate; none: unknown
};

/// The clearance in an empty world, m: no scenario is larger.
constexpr double kEmptyWorldClearance = 1000.0;

struct RunResult {
  Verdict verdict = Verdict::gave_up;
  std::string detail;  ///< a short explanation: which fault, which limit
  double time_s = 0;
  double path_m = 0;            ///< true distance driven by the centre of the body
  double final_distance_m = 0;  ///< true distance from the goal; not finite: unknown
  /// Distance between the goal and the estimated position; none: unknown.
  std::optional<double> believed_distance_m;
  double min_clearance_m =
      0;  ///< smallest true gap between body and obstacle; <= 0 at a contact; 1000 in an empty world
  std::optional<std::uint32_t> bumps;            ///< touches that pressed a bump switch; none: unknown
  std::optional<RangeTrust> ranges;              ///< at the end; none: unknown
  std::optional<localization::PoseSigma> sigma;  ///< of the estimated pose at the end; none: unknown
  /// Unreachable: the verdict holds only for gaps narrower than this, m; see narrowest_gap_m(). None: another
  /// verdict, or the planner has no local grid.
  std::optional<double> unreachable_above_m;
  double goal_tolerance_m = 0;
  std::optional<EventCount> events;  ///< none: the scenario has no events
  std::uint64_t ticks = 0;
  std::uint64_t hash = 0;  ///< FNV-1a 64 over the wheel commands of all ticks
};

}  // namespace whisker
