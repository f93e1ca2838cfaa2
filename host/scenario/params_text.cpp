#include "host/scenario/params_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace whisker {
namespace {

struct Keys {
  std::vector<std::string_view> all;
  template <class T>
  void number(const char* key, const T&, T, T) {
    all.emplace_back(key);
  }
  void count(const char* key, const std::int32_t&, std::int32_t, std::int32_t) { all.emplace_back(key); }
  template <class E>
  void choice(const char* key, const E&, const char* const*, int) {
    all.emplace_back(key);
  }
};

struct Row {
  std::string key, unit, value, range;
};

struct Rows {
  std::vector<Row> all;
  template <class T>
  void number(const char* key, const T& x, T low, T high) {
    const ParamUnit unit = unit_of(x);
    all.push_back({key, unit.symbol, si_text(x.raw(), unit),
                   si_text(low.raw(), unit) + " to " + si_text(high.raw(), unit)});
  }
  void count(const char* key, const std::int32_t& x, std::int32_t low, std::int32_t high) {
    all.push_back({key, "integer", fmt::format("{}", x), fmt::format("{} to {}", low, high)});
  }
  template <class E>
  void choice(const char* key, const E& x, const char* const* names, int count) {
    std::string words;
    for (int i = 0; i < count; ++i) words += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    all.push_back({key, "one of", fmt::format("\"{}\"", names[static_cast<int>(x)]), words});
  }
};

std::vector<Row> rows(const Params& params) {
  Rows rows;
  for_each_param(params, rows);
  return rows.all;
}

}  // namespace

std::int64_t to_raw(double si, ParamUnit unit) {
  return std::llround(si * unit.numerator / unit.denominator);
}

std::string si_text(std::int64_t raw, ParamUnit unit) {
  const double si = static_cast<double>(raw) * unit.denominator / unit.numerator;
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", si, digits);
    if (to_raw(std::strtod(text.c_str(), nullptr), unit) == raw) break;
  }
  // %g turns 20 into 2e+01; the shortest form of that very number does not.
  return fmt::format("{}", std::strtod(text.c_str(), nullptr));
}

std::vector<std::string_view> robot_keys() {
  Keys keys;
  const Params reference;
  for_each_param(reference, keys);
  return keys.all;
}

std::string robot_toml(const Params& params) {
  const std::vector<Row> reference = rows(Params{});
  const std::vector<Row> chosen = rows(params);
  std::string out;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i].value == reference[i].value) continue;
    out += fmt::format("{} = {}\n", chosen[i].key, chosen[i].value);
  }
  return out;
}

std::string params_markdown() {
  std::string out = "| Key | Unit | Default | Range |\n|---|---|---|---|\n";
  for (const Row& row : rows(Params{})) {
    out += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.unit, row.value, row.range);
  }
  return out;
}

const char* relation(ParamFault fault) {
  switch (fault) {
    case ParamFault::none: return "";
    case ParamFault::out_of_range: return "a parameter lies outside its own range";
    case ParamFault::track_wider_than_body:
      return "the wheels must lie within the body: wheel_track_m <= 2 body_radius_m";
    case ParamFault::ranges_reversed: return "range_min_m must be less than range_max_m";
    case ParamFault::cones_apart_from_front:
      return "the side beams must look ahead: range_side_angle_deg + range_cone_deg / 2 <= 90";
    case ParamFault::danger_inside_body:
      return "thesis_danger_range_m must be greater than body_radius_m + body_margin_m";
    case ParamFault::steps_reversed: return "thesis_small_step_m must not be greater than thesis_base_step_m";
    case ParamFault::stop_longer_than_range:
      return "the way to stop from wheel_speed_max_mps (braking at wheel_acceleration_max_mps2, motor_lag_s "
             "and the longest gap between two ticks: max_tick_gap_s, or at 0 what control_period_s makes it) "
             "must "
             "not be longer than range_max_m / 4";
    case ParamFault::stale_before_next_reading:
      return "stale_after_s must be greater than 1 / range_rate_hz + range_latency_s";
    case ParamFault::lost_before_stale: return "lost_after_s must not be less than stale_after_s";
    case ParamFault::tolerance_below_encoder:
      return "drive_tolerance_m, and the rim's way over turn_tolerance_deg (at wheel_track_m / 2), must not "
             "be less "
             "than 1 / encoder_counts_per_m";
    case ParamFault::gap_below_period: return "max_tick_gap_s must be at least 2 control_period_s, or 0";
    case ParamFault::cone_too_wide: return "range_cone_deg must not be greater than 60";
    case ParamFault::stuck_within_cone: return "stuck_turn_deg must be greater than range_cone_deg";
    case ParamFault::tolerance_above_step:
      return "drive_tolerance_m must be less than thesis_small_step_m, and turn_tolerance_deg less than "
             "thesis_delta_deg";
    case ParamFault::tolerance_below_wire:
      return "the rim's way over turn_tolerance_deg (at wheel_track_m / 2) must not be less than 0.0001 m/s "
             "x "
             "motion_settle_s";
    case ParamFault::stalled_before_count:
      return "wheels_stalled_after_s must not be less than 16 motor_lag_s + 6 control_period_s + 2 "
             "motion_settle_s + twice the time to accelerate over 1 / encoder_counts_per_m and to turn by as "
             "much at full turn rate";
    case ParamFault::step_beyond_range:
      return "range_clear_m and range_max_m must not be less than 2 thesis_base_step_m + body_radius_m + "
             "body_margin_m";
    case ParamFault::cone_too_narrow:
      return "the beams must be able to prove the ground near the body: range_offset_m + 0.72 cell / "
             "sin(range_cone_deg / 2) + cell <= 7/4 body_radius_m, with skirt_cell_m, or at 0 a suitable "
             "cell";
    case ParamFault::patch_too_small:
      return "15 cells must reach as far as body_radius_m + 0.72 cell + skirt_planning_margin_m + "
             "skirt_probe_m, with skirt_cell_m, or at 0 a suitable cell, and skirt_probe_m must not be less "
             "than body_radius_m / 2";
    case ParamFault::planning_below_shield:
      return "skirt_planning_margin_m must not be less than skirt_shield_margin_m";
    case ParamFault::settle_below_lag:
      return "motion_settle_s must not be less than motor_lag_s + control_period_s";
  }
  return "";
}

}  // namespace whisker
