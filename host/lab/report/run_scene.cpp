#include "host/lab/report/run_scene.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/lab/report/palette.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::report {
namespace {

using sim::Vec2;

constexpr std::size_t kMaxPathPoints = 9000;
constexpr std::size_t kMaxDots = 4000;
constexpr double kLeastAround = 4;  // m

Vec2 place(const TickRecord& r) { return {r.x_m, r.y_m}; }

Vec2 ahead(double heading, double distance) { return Vec2{std::cos(heading), std::sin(heading)} * distance; }

PathData polyline(const View& view, const std::vector<Vec2>& points, bool closed) {
  PathData data;
  for (std::size_t i = 0; i < points.size(); ++i)
    i == 0 ? data.move(view.page(points[i])) : data.line(view.page(points[i]));
  if (closed && !points.empty()) data.close();
  return data;
}

void draw_bounds(Svg& svg, const View& view, const Bounds& bounds, std::string_view attributes) {
  svg.rect(view.page({bounds.min.x, bounds.max.y}), (bounds.max.x - bounds.min.x) * view.pixels_per_metre,
           (bounds.max.y - bounds.min.y) * view.pixels_per_metre, attributes);
}

void draw_movers(Svg& svg, const View& view, const std::vector<Mover>& movers, double time_s) {
  if (movers.empty()) return;
  svg.open(R"(class="movers" fill="none" stroke="#7a5c3a")");
  for (const Mover& m : movers) {
    const double radius = m.radius_m * view.pixels_per_metre;
    svg.path(polyline(view, m.path, false), R"(stroke-width="1" stroke-dasharray="2 3")");
    svg.circle(view.page(m.center), radius, R"(stroke-dasharray="3 2")");
    svg.circle(view.page(mover_position(m.path, m.center, m.speed_mps * time_s)), radius,
               R"(class="mover" fill="#e3d3bf")");
  }
  svg.close();
}

double beam_length(const hal::RangeReading& reading, const RangefinderParams& sensor) {
  switch (reading.status) {
    case hal::RangeStatus::ok: return reading.mm / 1000.0;
    case hal::RangeStatus::clear: return metres(sensor.max_range);
    case hal::RangeStatus::too_near: return metres(sensor.min_range);
    case hal::RangeStatus::invalid:
    case hal::RangeStatus::stale: return 0;
  }
  return 0;
}

Box way_box(const Scenario& scenario, const std::vector<TickRecord>& records) {
  Box box;
  const double body = metres(scenario.robot.body.radius);
  box.add(scenario.start.at, body);
  box.add(scenario.goal.at, scenario.goal.tolerance_m);
  for (const TickRecord& r : records) box.add(place(r), body);
  return box;
}

Box world_box(const Scenario& scenario) {
  Box box;
  if (scenario.bounds) {
    box.add(scenario.bounds->min);
    box.add(scenario.bounds->max);
  }
  for (const sim::Disc& d : scenario.discs) box.add(d.center, d.radius);
  for (const auto& polygon : scenario.polygons)
    for (const Vec2 p : polygon) box.add(p);
  for (const auto& wall : scenario.walls)
    for (const Vec2 p : wall) box.add(p);
  for (const Mover& m : scenario.movers)
    for (const Vec2 p : m.path) box.add(p, m.radius_m);
  return box;
}

struct Label {
  Point at;
  double gap;  ///< px from the place to the text
  std::string_view text;
  const char* colour;
};

bool overlap(const Label& a, const Label& b) {
  return std::fabs(a.at.x - b.at.x) < 48 && std::fabs(a.at.y - b.at.y) < 14 + std::fabs(a.gap - b.gap);
}

void draw(Svg& svg, const View& view, const Label& label) {
  const bool below = label.at.y - label.gap < view.corner.y + 14;
  const double y = below ? label.at.y + label.gap + 11 : label.at.y - label.gap;
  const char* anchor = label.at.x < view.corner.x + 30  ? "start"
                       : label.at.x > view.right() - 30 ? "end"
                                                        : "middle";
  const double shift = anchor[0] == 's' ? -6 : anchor[0] == 'e' ? 6 : 0;
  svg.text({label.at.x + shift, y}, label.text,
           fmt::format(R"(text-anchor="{}" fill="{}")", anchor, label.colour));
}

}  // namespace

Box scene_box(const Scenario& scenario, const std::vector<TickRecord>& records) {
  Box box = way_box(scenario, records);
  const Box world = world_box(scenario);
  if (box.empty() || world.empty()) return box.empty() ? world : box;
  const Vec2 low = box.min();
  const Vec2 high = box.max();
  const double around = std::max({kLeastAround, high.x - low.x, high.y - low.y});
  box.add(
      {std::clamp(world.min().x, low.x - around, high.x), std::clamp(world.min().y, low.y - around, high.y)});
  box.add(
      {std::clamp(world.max().x, low.x, high.x + around), std::clamp(world.max().y, low.y, high.y + around)});
  return box;
}

void draw_world(Svg& svg, const View& view, const Scenario& scenario, double time_s) {
  const auto& bounds = scenario.bounds;
  svg.rect(view.corner, view.width(), view.height(), fmt::format(R"(fill="{}")", bounds ? kOutside : "#fff"));
  if (bounds) draw_bounds(svg, view, *bounds, R"(fill="#fff")");
  draw_grid(svg, view);
  if (bounds)
    draw_bounds(svg, view, *bounds, R"(class="bounds" fill="none" stroke="#454543" stroke-width="2")");
  svg.open(fmt::format(R"(class="obstacles" {})", kObstacle));
  for (const sim::Disc& d : scenario.discs)
    svg.circle(view.page(d.center), d.radius * view.pixels_per_metre, "");
  for (const auto& polygon : scenario.polygons) svg.path(polyline(view, polygon, true), "");
  svg.close();
  PathData walls;
  for (const auto& wall : scenario.walls)
    for (std::size_t i = 0; i < wall.size(); ++i)
      i == 0 ? walls.move(view.page(wall[i])) : walls.line(view.page(wall[i]));
  svg.path(walls, fmt::format(R"(class="walls" {})", kWall));
  draw_movers(svg, view, scenario.movers, time_s);
}

void draw_straight_way(Svg& svg, const View& view, const Scenario& scenario) {
  svg.line(view.page(scenario.start.at), view.page(scenario.goal.at),
           fmt::format(R"(class="straight-way" {})", kStraightWay));
}

void draw_goal(Svg& svg, const View& view, const Goal& goal) {
  const Point c = view.page(goal.at);
  const double radius = goal.tolerance_m * view.pixels_per_metre;
  PathData cross;
  cross.move({c.x - 4, c.y}).line({c.x + 4, c.y}).move({c.x, c.y - 4}).line({c.x, c.y + 4});
  svg.open(fmt::format(R"(class="goal" fill="none" stroke="{}" stroke-width="1.5")", kGoalColour));
  svg.circle(c, radius, R"(fill="#bfe6d6" fill-opacity="0.7")");
  if (radius < 5) svg.circle(c, 8, R"(stroke-width="1")");
  svg.path(cross, "").close();
}

void draw_path(Svg& svg, const View& view, const std::vector<TickRecord>& records, double tolerance_m) {
  const double invisible = 0.05 / view.pixels_per_metre;
  const std::vector<Piece> all = pieces(records, std::max(tolerance_m, invisible), kMaxPathPoints);
  svg.open(R"(class="path" fill="none" stroke-linejoin="round")");
  for (std::size_t k = 0; k < kDoings; ++k) {
    PathData data;
    for (const Piece& piece : all) {
      if (static_cast<std::size_t>(piece.doing) != k) continue;
      for (std::size_t i = 0; i < piece.points.size(); ++i)
        i == 0 ? data.move(view.page(piece.points[i])) : data.line(view.page(piece.points[i]));
    }
    const Look& look = kLooks[k];
    svg.path(data, fmt::format(R"(class="{}" stroke="{}" stroke-width="{}" stroke-dasharray="{}")", look.name,
                               look.colour, number(look.width), look.dashes));
  }
  svg.close();
}

void draw_looks(Svg& svg, const View& view, const std::vector<TickRecord>& records) {
  for (double cell = 1.5;; cell *= 2) {
    std::set<std::pair<long, long>> taken;
    PathData dots;
    for (const TickRecord& r : records) {
      if (!r.looked || !drawable(place(r))) continue;
      const Point p = view.page(place(r));
      if (taken.emplace(std::lround(p.x / cell), std::lround(p.y / cell)).second) dots.dot(p);
    }
    if (taken.size() > kMaxDots) continue;
    svg.path(dots, fmt::format(R"(class="looks" {})", kLookDot));
    return;
  }
}

std::vector<const TickRecord*> danger_entries(const std::vector<TickRecord>& records, int count) {
  constexpr double kApart = 0.3;
  std::vector<const TickRecord*> entries;
  int before = 0;
  for (const TickRecord& r : records) {
    const bool entered = before == 0 && r.danger_count > 0;
    before = r.danger_count;
    if (!entered || !drawable(place(r)) || static_cast<int>(entries.size()) >= count) continue;
    const bool near = std::any_of(entries.begin(), entries.end(), [&](const TickRecord* e) {
      return std::hypot(e->x_m - r.x_m, e->y_m - r.y_m) < kApart;
    });
    if (!near) entries.push_back(&r);
  }
  return entries;
}

void draw_cones(Svg& svg, const View& view, const RangefinderParams& sensor, const TickRecord& record) {
  svg.open(
      R"(class="cones" fill="#e69f00" fill-opacity="0.13" stroke="#8a6000" stroke-opacity="0.55" stroke-width="0.7")");
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    const double range = beam_length(record.ranges.beam[beam], sensor);
    if (range <= 0) continue;
    const Mount m = mount(sensor, beam);
    const double half = radians(m.half_cone);
    const double axis = record.heading_rad + radians(m.axis);
    const Vec2 apex = place(record) + ahead(record.heading_rad, metres(m.apex.x)) +
                      ahead(record.heading_rad + sim::kPi / 2, metres(m.apex.y));
    PathData sector;
    sector.move(view.page(apex));
    constexpr int kArc = 8;
    for (int i = 0; i <= kArc; ++i)
      sector.line(view.page(apex + ahead(axis - half + 2 * half * i / kArc, range)));
    svg.path(sector.close(), "");
  }
  svg.close();
}

void draw_body(Svg& svg, const View& view, double radius_m, const sim::Pose& pose, const char* group) {
  const Point c = view.page(pose.at);
  const double radius = radius_m * view.pixels_per_metre;
  const double tick = std::max(radius, 7.0) / view.pixels_per_metre;
  svg.open(group);
  svg.circle(c, radius, "");
  if (radius < 5) svg.circle(c, 7, R"(fill="none" stroke-width="1")");
  svg.line(c, view.page(pose.at + ahead(pose.heading, tick)), "");
  svg.close();
}

void draw_contact(Svg& svg, const View& view, double radius_m, const sim::Pose& pose) {
  const Point c = view.page(pose.at);
  const double radius = std::max(radius_m * view.pixels_per_metre, 7.0);
  const double arm = radius + 7;
  PathData cross;
  for (const double side : {-1.0, 1.0})
    cross.move({c.x - 0.707 * arm * side, c.y - 0.707 * arm})
        .line({c.x + 0.707 * arm * side, c.y + 0.707 * arm});
  svg.open(fmt::format(R"(class="contact" fill="none" stroke="{}" stroke-width="3")", kContactColour));
  svg.circle(c, radius, R"(fill="#ffd9ec" fill-opacity="0.6")");
  svg.path(cross, R"(stroke-linecap="round")");
  svg.close();
}

void draw_labels(Svg& svg, const View& view, const Scenario& scenario, const TickRecord* end,
                 Verdict verdict) {
  const double body = std::max(metres(scenario.robot.body.radius) * view.pixels_per_metre, 8.0);
  const double circle = std::max(scenario.goal.tolerance_m * view.pixels_per_metre, 8.0);
  std::vector<Label> labels;
  const auto add = [&](const Label& label) {
    for (const Label& other : labels)
      if (overlap(label, other)) return;
    labels.push_back(label);
  };
  if (end != nullptr && verdict == Verdict::contact)
    add({view.page({end->x_m, end->y_m}), body + 10, "contact", kContactColour});
  add({view.page(scenario.goal.at), circle + 5, "goal", kGoalColour});
  add({view.page(scenario.start.at), body + 5, "start", "#222"});
  if (end != nullptr) add({view.page({end->x_m, end->y_m}), body + 5, "end", "#222"});
  svg.open(
      R"(class="labels" font-weight="bold" stroke="#fff" stroke-width="3" stroke-linejoin="round" paint-order="stroke")");
  for (const Label& label : labels) draw(svg, view, label);
  svg.close();
}

}  // namespace whisker::report
