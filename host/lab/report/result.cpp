#include "host/lab/report/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/lab/report/svg.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::report {
namespace {

using Json = nlohmann::ordered_json;

/// Six decimals print shortly: 0.1 + 0.2 becomes 0.3.
Json rounded(double x) {
  const double y = std::round(x * 1e6) / 1e6;
  return std::isfinite(y) ? Json(y + 0.0) : Json(nullptr);
}

const char* opening(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::reached: return "reached in";
    case Verdict::off_goal: return "believes it is there; is";
    case Verdict::unreachable: return "found unreachable after";
    case Verdict::gave_up: return "gave up after";
    case Verdict::contact: return "contact after";
    case Verdict::fault: return "stopped by a fault after";
  }
  return "?";
}

/// What the scenario has that contradicts the robot's belief, with the parameter to change if one helps.
std::vector<std::string> causes_of_doubt(const Scenario& s) {
  const RangefinderParams& believed = s.robot.rangefinders;
  std::vector<std::string> all;
  if (!s.movers.empty()) all.emplace_back("things that move");
  const double incidence_deg = degrees(believed.incidence), cone_deg = degrees(believed.cone);
  if (s.sensor.incidence_deg < incidence_deg) {
    Params fits = s.robot;
    fits.rangefinders.incidence =
        Angle::turns(static_cast<std::int32_t>(std::lround(s.sensor.incidence_deg * 1000)), 360000);
    all.push_back(fmt::format("walls vanish beyond {:g} degrees, and range_incidence_deg is {:g} ({})",
                              s.sensor.incidence_deg, incidence_deg,
                              check(fits) == ParamFault::none
                                  ? fmt::format("set {:g}", s.sensor.incidence_deg)
                                  : "other angles fit, see whisker robot layout"));
  }
  if (s.sensor.cone_deg && *s.sensor.cone_deg < cone_deg - 0.01)
    all.push_back(fmt::format("the cones are {:g} degrees wide, and range_cone_deg is {:g}",
                              *s.sensor.cone_deg, cone_deg));
  if (s.sensor.max_range_m && *s.sensor.max_range_m < metres(believed.max_range))
    all.push_back(fmt::format("the sensors see up to {:g} m, and range_max_m is {:g}", *s.sensor.max_range_m,
                              metres(believed.max_range)));
  if (s.sensor.skew_deg != 0)
    all.push_back(fmt::format("the side beams point {:g} degrees farther out than range_*_angle_deg",
                              s.sensor.skew_deg));
  if (s.sensor.scale != 1) all.push_back(fmt::format("distances are {:g} times as long", s.sensor.scale));
  if (s.sensor.crosstalk > 0) all.emplace_back("crosstalk");
  if (s.sensor.phantom > 0)
    all.emplace_back("phantoms at 0.1 to 0.5 m (a range_clear_m below their distance keeps them out)");
  if (s.sensor.cover_glass_probability > 0) all.emplace_back("echoes of the cover glass");
  if (s.sensor.soft > 0 || s.sensor.reflectance < 1 || s.sensor.ambient_klux > 0)
    all.emplace_back("obstacles that absorb, or light");
  if (s.noise.range_false_clear > 0) all.emplace_back("false clear readings");
  if (all.empty() && incidence_deg < 90)
    all.push_back(
        fmt::format("walls beyond {:g} degrees give no echo, as range_incidence_deg says", incidence_deg));
  return all;
}

}  // namespace

const char* outcome(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::reached: return "reached";
    case Verdict::off_goal: return "off_goal";
    case Verdict::unreachable: return "unreachable";
    case Verdict::gave_up: return "gave_up";
    case Verdict::contact: return "contact";
    case Verdict::fault: return "fault";
  }
  return "?";
}

double contradictions_per_m(const RangeTrust& ranges) {
  return static_cast<double>(ranges.contradictions) / RangeTrust::kOnePerMetre;
}

double share(std::uint16_t part) { return part / 65536.0; }

std::string range_warning(const RangeTrust& ranges, const Scenario& s) {
  if (ranges.level == RangeLevel::trusted) return "";
  const double phantoms = share(ranges.phantoms);
  const double false_clears = share(ranges.false_clears);
  const double most = std::max(phantoms, false_clears);
  std::string figure = fmt::format("{:.1f} contradictions per metre", contradictions_per_m(ranges));
  if (most >= 0.2)
    figure =
        fmt::format("{:.0f} % {}", 100 * most, phantoms > false_clears ? "phantoms" : "false clear readings");
  std::string causes;
  for (const std::string& cause : causes_of_doubt(s)) causes += (causes.empty() ? "" : ", ") + cause;
  if (causes.empty()) causes = "none in the parameters, which agree with the sensors";
  return fmt::format("the ranges are {}: {}; what may cause it: {}", name(ranges.level), figure, causes);
}

std::string result_json(const RunResult& result, const std::string& bus, const char* said) {
  Json json;
  json["outcome"] = said != nullptr ? said : outcome(result.verdict);
  json["time_s"] = rounded(result.time_s);
  json["path_m"] = rounded(result.path_m);
  json["final_distance_m"] = rounded(result.final_distance_m);
  json["believed_distance_m"] = result.believed_distance_m ? rounded(*result.believed_distance_m) : nullptr;
  json["min_clearance_m"] = rounded(result.min_clearance_m);
  json["ticks"] = result.ticks;
  json["hash"] = fmt::format("{:016x}", result.hash);
  json["detail"] = result.detail;
  json["bumps"] = result.bumps ? Json(*result.bumps) : Json(nullptr);
  const auto ranges = [&](auto figure) {
    return result.ranges ? Json(figure(*result.ranges)) : Json(nullptr);
  };
  json["range_trust"] = ranges([](const RangeTrust& r) { return Json(name(r.level)); });
  json["contradictions_per_m"] = ranges([](const RangeTrust& r) { return rounded(contradictions_per_m(r)); });
  json["phantom_share"] = ranges([](const RangeTrust& r) { return rounded(share(r.phantoms)); });
  json["false_clear_share"] = ranges([](const RangeTrust& r) { return rounded(share(r.false_clears)); });
  json["incidence_seen_deg"] =
      ranges([](const RangeTrust& r) { return r.incidence_deg > 0 ? Json(r.incidence_deg) : Json(nullptr); });
  if (result.unreachable_above_m) json["unreachable_above_m"] = rounded(*result.unreachable_above_m);
  const auto sigma = [&](auto figure) {
    return result.sigma ? rounded(figure(*result.sigma)) : Json(nullptr);
  };
  json["bound_m"] = sigma([](const localization::PoseSigma& s) { return metres(distance_bound(s)); });
  json["sigma_along_m"] = sigma([](const localization::PoseSigma& s) { return metres(s.along); });
  json["sigma_across_m"] = sigma([](const localization::PoseSigma& s) { return metres(s.across); });
  json["sigma_heading_deg"] = sigma([](const localization::PoseSigma& s) { return degrees(s.heading); });
  if (result.events)
    json["events"] = {{"played", result.events->played}, {"refused", result.events->refused}};
  if (!bus.empty()) json["bus"] = Json::parse(bus);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string bound_words(const RunResult& result) {
  if (!result.sigma) return "";
  const double bound_m = metres(distance_bound(*result.sigma));
  const bool wide = bound_m > result.goal_tolerance_m;
  if (result.verdict == Verdict::unreachable && wide) {
    return fmt::format(", unless the goal is elsewhere: the place is known within {:.2f} m (2 sigma)",
                       bound_m);
  }
  if (!says_reached(result.verdict)) return "";
  return fmt::format(
      ", within {:.2f} m (2 sigma){}", bound_m,
      wide ? fmt::format(", more than the tolerance of {:.2f} m", result.goal_tolerance_m) : "");
}

std::string verdict_words(const RunResult& result) {
  std::string words = opening(result.verdict);
  if (result.verdict == Verdict::off_goal)
    words += fmt::format(" {:.2f} m off, after", result.final_distance_m);
  words += fmt::format(" {:.1f} s, {:.2f} m", result.time_s, result.path_m);
  if (!says_reached(result.verdict))
    words += fmt::format(", {:.2f} m from the goal", result.final_distance_m);
  if (result.unreachable_above_m)
    words += fmt::format(", if all gaps are below {:.3f} m", *result.unreachable_above_m);
  if (result.min_clearance_m < kEmptyWorldClearance)
    words += fmt::format(", min clearance {} m", decimals(result.min_clearance_m, 3));
  if (result.bumps.value_or(0) > 0)
    words += fmt::format(", {} bump{}", *result.bumps, *result.bumps == 1 ? "" : "s");
  words += bound_words(result);
  if (!result.detail.empty()) words += fmt::format(" ({})", result.detail);
  return words;
}

}  // namespace whisker::report
