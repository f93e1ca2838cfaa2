#include "host/lab/campaign/layouts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "host/harness/scenario/coverage.hpp"
#include "host/harness/scenario/params_text.hpp"

namespace whisker::campaign {
namespace {

void scale(Length& length, double by, double low_m, double high_m) {
  set_si(length, std::clamp(length.raw() * 1e-6 * by, low_m, high_m));
}

std::vector<double> usual_angles(const Params& robot) {
  std::vector<double> angles;
  for (double angle = kFirstAngle; angle <= kLastAngle; angle += kAngleStep) angles.push_back(angle);
  const double rule = std::ceil(rule_angle_deg(robot, true) * 2 - 1e-6) / 2;
  const auto at = std::lower_bound(angles.begin(), angles.end(), rule);
  if (rule > kFirstAngle && (at == angles.end() || *at != rule)) angles.insert(at, rule);
  return angles;
}

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-6;  // deg

std::optional<double> median_pace(const Row* first, std::size_t count) {
  std::vector<double> paces;
  for (const Row* row = first; row != first + count; ++row) {
    paces.push_back(truly_there(*row) ? s_per_m(*row).value_or(kNever) : kNever);
  }
  std::sort(paces.begin(), paces.end());
  const double median = paces[(count - 1) / 2];
  return median == kNever ? std::nullopt : std::optional(median);
}

/// 2: every wall ahead is seen, with the margin; 1: without; 0: some are not.
int walls(const LayoutScore& s) {
  return s.margin_deg >= kIncidenceMargin - kRounding ? 2 : s.margin_deg >= -kRounding ? 1 : 0;
}
std::uint64_t failed(const LayoutScore& s) { return s.missions - s.reached; }
double pace(const LayoutScore& s) { return s.s_per_m.value_or(kNever); }

template <class Same>
std::uint64_t count(const std::vector<LayoutScore>& all, const Same& same) {
  return static_cast<std::uint64_t>(std::count_if(all.begin(), all.end(), same));
}

}  // namespace

Params scaled(Params p, double size) {
  scale(p.body.radius, size, 0.02, 1);
  scale(p.body.margin, size, 0, 0.5);
  scale(p.body.track, size, 0.02, 2);
  scale(p.boundary.guard_margin, size, 0, 0.5);
  scale(p.boundary.length_budget, size, 1, 2000);
  return p;
}

Params equipped(Params p, const SensorModel& model) {
  RangefinderParams& r = p.rangefinders;
  for (BeamParams& beam : r.beams) beam = {};
  set_si(r.incidence, model.incidence_deg);
  set_si(r.min_range, model.min_range_m);
  set_si(r.max_range, model.max_range_m);
  const double taper = model.cone_deg - std::min(model.cone_deg, model.cone_far_deg);
  set_si(r.cone, model.cone_deg - taper * proving_range(r).raw() / r.max_range.raw());
  r.rate_hz = model.rate_hz;
  set_si(r.latency, model.latency_s);
  const double oldest = 1.0 / model.rate_hz + model.latency_s;
  // A lost reading must not make a slow sensor stale.
  set_si(p.conditioning.stale_after, std::max(p.conditioning.stale_after.raw() * 1e-3, 2.5 * oldest));
  return p;
}

double rule_angle_deg(const Params& robot, bool with_margin) {
  const double half_cone = robot.rangefinders.cone.wrapped() * (90.0 / 2147483648.0);
  return 90 + (with_margin ? kIncidenceMargin : 0) - seen_incidence_deg(robot, {}) - half_cone;
}

LayoutGrid layout_grid(const Params& robot, std::vector<double> angles_deg) {
  LayoutGrid grid;
  grid.angles_deg = angles_deg.empty() ? usual_angles(robot) : std::move(angles_deg);
  std::sort(grid.angles_deg.begin(), grid.angles_deg.end());
  grid.angles_deg.erase(std::unique(grid.angles_deg.begin(), grid.angles_deg.end()), grid.angles_deg.end());
  const double radius = robot.body.radius.raw() * 1e-6;
  for (const double part : kOffsets) grid.offsets_m.push_back(std::round(part * radius * 1e3) * 1e-3);
  for (const double offset : grid.offsets_m) {
    for (const double angle : grid.angles_deg) {
      Layout layout{angle, offset, robot};
      set_si(layout.robot.rangefinders.side_angle, angle);
      set_si(layout.robot.rangefinders.offset, offset);
      const ParamFault fault = check(layout.robot);
      if (fault == ParamFault::none) {
        grid.layouts.push_back(layout);
      } else {
        ++grid.refusals[static_cast<std::size_t>(fault)];
        ++grid.refused;
      }
    }
  }
  return grid;
}

Scenario layout_scenario(const Layout& layout, const Sensor& sensor, worlds::Kind kind, std::uint64_t seed) {
  worlds::Options options;
  options.seed = seed;
  Scenario scenario = worlds::generate(kind, options);
  scenario.time_limit_s = kLayoutTimeLimit;
  fit_to(scenario, layout.robot);
  scenario.sensor = sensor;
  return scenario;
}

LayoutScore score(const Layout& layout, const Sensor& sensor, const std::vector<Row>& rows) {
  LayoutScore s;
  s.layout = layout;
  s.needed_incidence_deg = needed_incidence_deg(layout.robot, sensor);
  s.margin_deg = seen_incidence_deg(layout.robot, sensor) - s.needed_incidence_deg;
  s.unseen = unseen_strip(layout.robot, sensor);
  s.missions = rows.size();
  for (const Row& row : rows) {
    s.reached += truly_there(row) ? 1U : 0U;
    s.contacts += row.verdict == Verdict::contact ? 1U : 0U;
  }
  s.success = share(s.reached, s.missions);
  s.contact = share(s.contacts, s.missions);
  s.s_per_m = median_pace(rows.data(), rows.size());
  const std::size_t each = rows.size() / kLayoutKinds;
  for (std::size_t k = 0; k < kLayoutKinds; ++k) {
    s.world_s_per_m[k] = median_pace(rows.data() + k * each, each);
  }
  return s;
}

void rank(std::vector<LayoutScore>& scores) {
  const auto key = [](const LayoutScore& s) {
    return std::tuple(-walls(s), s.contacts, failed(s), pace(s), s.layout.offset_m, s.layout.side_angle_deg);
  };
  std::sort(scores.begin(), scores.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

std::string reason(const std::vector<LayoutScore>& all) {
  const LayoutScore& best = all.front();
  const auto seen = [&](const LayoutScore& s) { return walls(s) == walls(best); };
  const auto untouched = [&](const LayoutScore& s) { return seen(s) && s.contacts == best.contacts; };
  const auto equal = [&](const LayoutScore& s) { return untouched(s) && s.reached == best.reached; };
  constexpr const char* kWalls[] = {"none sees every wall ahead, so that all {} are compared",
                                    "{} see every wall ahead, none of them with {} degrees to spare",
                                    "{} see every wall ahead with {} degrees to spare"};
  std::string text = fmt::format("of {} layouts, ", all.size()) +
                     fmt::format(fmt::runtime(kWalls[walls(best)]), count(all, seen), kIncidenceMargin);
  text +=
      fmt::format("; {} of these with the fewest contacts ({} in {} missions; 95 % bound {:.0f} %)",
                  count(all, untouched), best.contacts, best.missions, 100 * best.contact.high.value_or(1));
  text += fmt::format("; {} of these with the most goals reached ({} of {})", count(all, equal), best.reached,
                      best.missions);
  if (best.s_per_m) return text + fmt::format("; the fastest of these ({:.1f} s/m)", *best.s_per_m);
  return text + "; fewer than half of the missions reach their goal, so that no time is compared";
}

}  // namespace whisker::campaign
