#include "host/cli/layout_output.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "firmware/params/relations.hpp"
#include "host/report/layout_svg.hpp"
#include "host/report/units.hpp"
#include "host/scenario/params_text.hpp"
#include "host/scenario/sensor_text.hpp"

namespace whisker::cli {
namespace {

using campaign::LayoutScore;
using report::degrees;
using report::metres;
using Json = nlohmann::ordered_json;

constexpr const char* kWorlds = "30 discs, U-traps, mazes and rooms";

/// Without the remainder of the fixed-point unit.
double tidy(double x) { return campaign::rounded(x); }

std::string pace(const std::optional<double>& s_per_m) {
  return s_per_m ? fmt::format("{:.1f}", *s_per_m) : "-";
}

std::string row(const LayoutScore& s) {
  std::string text = fmt::format("{:6.1f} {:7.3f} {:7.1f} {:+7.1f} {:6.0f} % {:6.0f} % {:>6}",
                                 s.layout.side_angle_deg, s.layout.offset_m, s.needed_incidence_deg,
                                 s.margin_deg, 100 * s.success.value, 100 * s.contact.value, pace(s.s_per_m));
  for (const auto& world : s.world_s_per_m) text += fmt::format(" {:>6}", pace(world));
  return text + fmt::format(" {:6.0f}\n", s.unseen.width() * 1e3);
}

Json estimate(const campaign::Estimate& e) {
  const auto bound = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  return {{"value", e.value}, {"low", bound(e.low)}, {"high", bound(e.high)}};
}

Json score_json(const LayoutScore& s) {
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json worlds = Json::object();
  for (int k = 0; k < campaign::kLayoutKinds; ++k) {
    worlds[name(campaign::kLayoutWorlds[k])] = number(s.world_s_per_m[k]);
  }
  return {{"side_angle_deg", s.layout.side_angle_deg},
          {"offset_m", s.layout.offset_m},
          {"needed_incidence_deg", tidy(s.needed_incidence_deg)},
          {"margin_deg", tidy(s.margin_deg)},
          {"unseen_strip_m", tidy(s.unseen.width())},
          {"missions", s.missions},
          {"success", estimate(s.success)},
          {"contact", estimate(s.contact)},
          {"s_per_m", number(s.s_per_m)},
          {"world_s_per_m", worlds}};
}

std::string place(const campaign::Layout& layout) {
  return fmt::format("range_side_angle_deg = {}, range_offset_m = {:.3f}", layout.side_angle_deg,
                     layout.offset_m);
}

}  // namespace

std::string refused_words(const campaign::LayoutGrid& grid) {
  std::string text;
  for (int i = 0; i < kParamFaults; ++i) {
    const std::uint64_t count = grid.refusals[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", relation(static_cast<ParamFault>(i)).name, count);
  }
  return text;
}

std::string layout_words(const LayoutTrade& t) {
  const RangefinderParams& r = t.robot.rangefinders;
  std::string offsets;
  for (const double offset : t.grid.offsets_m) {
    offsets += fmt::format("{}{:.3f}", offsets.empty() ? "" : ", ", offset);
  }
  std::string text = fmt::format(
      "{} on a body of {:.3f} m: cone {:.1f} degrees, walls echo up to L = {:.0f} degrees, {:.2f} to {:.2f} "
      "m, "
      "{} Hz, {} ms\n",
      t.sensor, metres(t.robot.body.radius), degrees(r.cone), degrees(r.incidence), metres(r.min_range),
      metres(r.max_range), r.rate_hz, r.latency.raw());
  text += fmt::format("side angles {} to {} degrees, offsets {} m; check() refuses {} of {}{}\n",
                      t.grid.angles_deg.front(), t.grid.angles_deg.back(), offsets, t.grid.refused,
                      t.grid.refused + t.grid.layouts.size(),
                      t.grid.refused == 0 ? "" : ": " + refused_words(t.grid));
  text += fmt::format("missions of a layout in each of {1}: {0}, seeds {2} to {3}\n\n", t.count, kWorlds,
                      t.seed, t.seed + t.count - 1);
  text += " angle  offset  L from  margin  success  contact    s/m  discs u-trap   maze  rooms unseen\n";
  text += "   deg       m     deg     deg                                                        mm\n";
  for (const LayoutScore& s : t.ranked) text += row(s);
  text += fmt::format("\nbest: {}\nwhy: {}\n", place(t.ranked.front().layout), campaign::reason(t.ranked));
  for (const double offset : t.grid.offsets_m) {
    const auto best = std::find_if(t.ranked.begin(), t.ranked.end(),
                                   [&](const LayoutScore& s) { return s.layout.offset_m == offset; });
    if (best != t.ranked.end() && best != t.ranked.begin()) {
      text += fmt::format("best with this offset: {}\n", place(best->layout));
    }
  }
  return text;
}

std::string layout_json(const LayoutTrade& t) {
  const RangefinderParams& r = t.robot.rangefinders;
  Json layouts = Json::array(), worlds = Json::array(), refusals = Json::object();
  for (const LayoutScore& s : t.ranked) layouts.push_back(score_json(s));
  for (const worlds::Kind kind : campaign::kLayoutWorlds) worlds.push_back(name(kind));
  for (int i = 0; i < kParamFaults; ++i) {
    const std::uint64_t count = t.grid.refusals[static_cast<std::size_t>(i)];
    if (count != 0) refusals[relation(static_cast<ParamFault>(i)).name] = count;
  }
  const Json json = {{"sensor", t.sensor},
                     {"body_radius_m", metres(t.robot.body.radius)},
                     {"cone_deg", tidy(degrees(r.cone))},
                     {"incidence_deg", tidy(degrees(r.incidence))},
                     {"rule_angle_deg", tidy(campaign::rule_angle_deg(t.robot, false))},
                     {"worlds", worlds},
                     {"missions_per_world", t.count},
                     {"angles_deg", t.grid.angles_deg},
                     {"offsets_m", t.grid.offsets_m},
                     {"refused", t.grid.refused},
                     {"refusals", refusals},
                     {"layouts", layouts},
                     {"best", layouts.front()},
                     {"why", campaign::reason(t.ranked)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string layout_picture(const LayoutTrade& t) {
  report::LayoutChart chart;
  chart.title =
      fmt::format("Where to mount three {} on a body of {:.3f} m", t.sensor, metres(t.robot.body.radius));
  chart.subtitle = fmt::format("{} missions a point in {}; cone {:.1f} degrees, L = {:.0f} degrees",
                               t.count * campaign::kLayoutKinds, kWorlds, degrees(t.robot.rangefinders.cone),
                               degrees(t.robot.rangefinders.incidence));
  chart.rule_angle_deg = campaign::rule_angle_deg(t.robot, false);
  chart.margin_deg = kIncidenceMargin;
  for (const double offset : t.grid.offsets_m) {
    report::LayoutLine line{fmt::format("offset {:.3f} m", offset), {}};
    for (const LayoutScore& s : t.ranked) {
      if (s.layout.offset_m != offset) continue;
      line.points.push_back(
          {s.layout.side_angle_deg, s.success.value, s.s_per_m, s.contacts > 0, &s == t.ranked.data()});
    }
    std::sort(line.points.begin(), line.points.end(),
              [](const auto& a, const auto& b) { return a.angle_deg < b.angle_deg; });
    if (!line.points.empty()) chart.lines.push_back(line);
  }
  return report::layout_svg(chart);
}

std::string layout_robot_file(const LayoutTrade& t) {
  const LayoutScore& best = t.ranked.front();
  return fmt::format(
      "# Three {} where `whisker robot layout` puts them: side angle {} degrees, offset {:.3f} m.\n{}{}",
      t.sensor, best.layout.side_angle_deg, best.layout.offset_m, robot_toml(best.layout.robot),
      sensor_toml(t.what));
}

}  // namespace whisker::cli
