#include "host/lab/report/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

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

std::string range_warning(const RangeTrust& ranges) {
  if (ranges.level == RangeLevel::trusted) return "";
  const std::string level = fmt::format("the ranges are {}: ", name(ranges.level));
  const double phantoms = share(ranges.phantoms);
  const double false_clears = share(ranges.false_clears);
  if (std::max(phantoms, false_clears) >= 0.2) {
    const bool near = phantoms > false_clears;
    return level + fmt::format("{:.0f} % {}; check the sensors{}", 100 * std::max(phantoms, false_clears),
                               near ? "phantoms" : "false clear readings",
                               near ? ", or set range_clear_m below the distance of the phantoms" : "");
  }
  const std::string rate = fmt::format("{:.1f} contradictions per metre", contradictions_per_m(ranges));
  const int seen = ranges.incidence_deg;
  if (seen > 0 && seen < 55) {
    return level + fmt::format(
                       "{}, and walls are seen up to {} degrees only; set range_incidence_deg = {} if the "
                       "sensors lose "
                       "oblique walls, else check which sensor is which",
                       rate, seen, seen);
  }
  return level + fmt::format(
                     "{}; check range_*_angle_deg, range_*_cone_deg, range_incidence_deg and which sensor is "
                     "which",
                     rate);
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
