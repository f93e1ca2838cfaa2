#include "host/lab/paths/search.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::paths {
namespace {

using sim::Vec2;

constexpr double kSlack = 1e-9;    // rad; a smaller angle backwards counts as rounding
constexpr double kBetter = 1e-13;  // m; a path must be shorter by this, so that rounding decides nothing

/// The angle at which a line with this normal touches a rim on this side.
double touch_angle(double normal_angle, Side side) {
  return side == Side::left ? normal_angle + kFullTurn / 2 : normal_angle;
}

}  // namespace

Search::Search(const Inflated& inflated, Vec2 from, Vec2 to)
    : inflated_(inflated), start_{from, 0}, goal_{to, 0}, ranges_(2 * inflated.rims().size()) {
  for (std::size_t i = 0; i < inflated.rims().size(); ++i) arcs_.emplace_back(inflated, i);
}

std::optional<Way> Search::shortest() {
  const Range first = tangents_from({kStart, Side::left});
  for (int i = first.first; i < first.last; ++i) reach(i, 0, -1, true, 0);
  while (!queue_.empty()) {
    const int here = queue_.top().node;
    queue_.pop();
    if (node(here).done) continue;
    node(here).done = true;
    if (node(here).stand.rim == kGoal) return way_to(here);
    if (node(here).stand.rim != kStart) go_around(here);
    if (inflated_.free(node(here).tangent.line)) arrive(here);
  }
  return std::nullopt;
}

const sim::Disc& Search::disc(Stand stand) const {
  if (stand.rim == kStart) return start_;
  if (stand.rim == kGoal) return goal_;
  return inflated_.rims()[static_cast<std::size_t>(stand.rim)];
}

Search::Range Search::tangents_from(Stand from) {
  const int first = static_cast<int>(nodes_.size());
  add_tangent(from, {kGoal, Side::left});
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (static_cast<int>(i) == from.rim || arcs_[i].empty()) continue;
    for (const Side side : {Side::left, Side::right}) add_tangent(from, {static_cast<int>(i), side});
  }
  std::sort(nodes_.begin() + first, nodes_.end(), [](const Node& a, const Node& b) {
    if (a.place.arc != b.place.arc) return a.place.arc < b.place.arc;
    return a.place.offset_rad < b.place.offset_rad;
  });
  return {first, static_cast<int>(nodes_.size())};
}

void Search::add_tangent(Stand from, Stand to) {
  const std::optional<Tangent> t = tangent(disc(from), from.side, disc(to), to.side);
  if (!t) return;
  const double normal_angle = sim::arc_tangent(t->normal.y, t->normal.x);
  std::optional<Place> leaves = Place{};
  if (from.rim >= 0) leaves = arcs(from).find(touch_angle(normal_angle, from.side), from.side);
  if (!leaves) return;
  std::optional<Place> arrives = Place{};
  if (to.rim >= 0) arrives = arcs(to).find(touch_angle(normal_angle, to.side), to.side);
  if (!arrives) return;
  Node n;
  n.stand = from;
  n.place = *leaves;
  n.tangent = *t;
  n.to = to;
  n.to_place = *arrives;
  nodes_.push_back(n);
}

void Search::arrive(int from) {
  const Stand to = node(from).to;
  const double way_m = node(from).way_m + node(from).tangent.length_m;
  if (to.rim == kGoal) {
    Node end;
    end.stand = to;
    end.tangent.line.a = goal_.center;
    nodes_.push_back(end);
    reach(static_cast<int>(nodes_.size()) - 1, way_m, from, true, 0);
    return;
  }
  Range& range = ranges_[2 * static_cast<std::size_t>(to.rim) + (to.side == Side::left ? 0 : 1)];
  if (range.first < 0) range = tangents_from(to);
  const Place place = node(from).to_place;
  int next = range.first;
  const auto before = [&](const Place& p) {
    return p.arc < place.arc || (p.arc == place.arc && p.offset_rad < place.offset_rad - kSlack);
  };
  while (next < range.last && before(node(next).place)) ++next;
  double swept = 0;
  if (next == range.last && arcs(to).whole()) {
    next = range.first;
    swept = kFullTurn;
  }
  if (next == range.last || node(next).place.arc != place.arc) return;
  swept = std::fmax(0, swept + node(next).place.offset_rad - place.offset_rad);
  reach(next, way_m + swept * disc(to).radius, from, true, swept);
}

void Search::go_around(int from) {
  const Stand stand = node(from).stand;
  const Range range = ranges_[2 * static_cast<std::size_t>(stand.rim) + (stand.side == Side::left ? 0 : 1)];
  int next = from + 1;
  double swept = 0;
  if (next == range.last) {
    if (!arcs(stand).whole()) return;
    next = range.first;
    swept = kFullTurn;
  }
  if (node(next).place.arc != node(from).place.arc) return;
  swept += node(next).place.offset_rad - node(from).place.offset_rad;
  reach(next, node(from).way_m + swept * disc(stand).radius, from, false, swept);
}

void Search::reach(int i, double way_m, int before, bool by_tangent, double swept_rad) {
  Node& n = node(i);
  if (n.done || (n.known && way_m > n.way_m - kBetter)) return;
  n.known = true;
  n.way_m = way_m;
  n.before = before;
  n.by_tangent = by_tangent;
  n.swept_rad = swept_rad;
  queue_.push({way_m + distance(n.tangent.line.a, goal_.center), i});
}

Way Search::way_to(int last) {
  Way way;
  way.length_m = node(last).way_m;
  std::vector<Leg> backwards;
  for (int i = last; node(i).before >= 0; i = node(i).before) {
    // Around the rim, from tangent to tangent, back to the path's arrival point.
    const Stand stand = node(i).stand;
    Leg arc{{}, node(i).tangent.line.a, disc(stand), 0};
    double swept_rad = node(i).swept_rad;
    for (; !node(i).by_tangent; i = node(i).before) swept_rad += node(node(i).before).swept_rad;
    const Tangent& before = node(node(i).before).tangent;
    arc.from = before.line.b;
    arc.turn_rad = swept_rad * static_cast<int>(stand.side);
    if (swept_rad > 0) backwards.push_back(arc);
    if (before.length_m > 0) backwards.push_back({before.line.a, before.line.b, {}, 0});
  }
  way.legs.assign(backwards.rbegin(), backwards.rend());
  return way;
}

}  // namespace whisker::paths
