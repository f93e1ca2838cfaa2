#include "host/lab/play/flat.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/limits.hpp"
#include "host/harness/scenario/shapes.hpp"

namespace whisker::play {
namespace {

constexpr Limits kSeed{0, 9007199254740991.0};

using Points = std::vector<sim::Vec2>;

void add(std::vector<double>& list, const Points& points) {
  list.push_back(static_cast<double>(points.size()));
  for (const sim::Vec2 p : points) list.insert(list.end(), {p.x, p.y});
}

void add(std::vector<double>& list, const std::vector<Points>& lines) {
  list.push_back(static_cast<double>(lines.size()));
  for (const Points& line : lines) add(list, line);
}

/// Reads one number after the other, and remembers whether all were valid.
class Reader {
 public:
  explicit Reader(const std::vector<double>& list) : list_(list) {}

  double number(Limits limits) {
    const double x = at_ < list_.size() ? list_[at_] : std::nan("");
    ++at_;
    if (limits.allow(x)) return x;
    good_ = false;
    return limits.high;
  }
  double whole(Limits limits) {
    const double x = number(limits);
    demand(x == std::floor(x));
    return x;
  }
  double length() { return number(kLength); }
  sim::Vec2 point() {
    const double x = number(kCoordinate);
    return {x, number(kCoordinate)};
  }
  std::size_t count(std::size_t least, std::size_t most) {
    const double n = whole({static_cast<double>(least), static_cast<double>(most)});
    return good_ ? static_cast<std::size_t>(n) : 0;
  }
  /// The obstacles of all kinds together.
  std::size_t things() {
    const std::size_t n = count(0, kMostThings - things_);
    things_ += n;
    return n;
  }
  Points points(std::size_t least) {
    Points points(count(least, std::min(kMostPoints, kMostPointsOfAll - points_)));
    points_ += points.size();
    for (sim::Vec2& p : points) p = point();
    demand(all_differ(points));
    return points;
  }
  std::vector<Points> lines(std::size_t least) {
    std::vector<Points> lines(things());
    for (Points& line : lines) {
      if (good_) line = points(least);
    }
    return lines;
  }
  void demand(bool good) { good_ = good_ && good; }
  bool good() const { return good_; }
  bool all_good() const { return good_ && at_ == list_.size(); }

 private:
  const std::vector<double>& list_;
  std::size_t at_ = 0;
  std::size_t things_ = 0;
  std::size_t points_ = 0;
  bool good_ = true;
};

void read_obstacles(Reader& read, Scenario& s) {
  s.discs.resize(read.things());
  for (sim::Disc& d : s.discs) {
    d.center = read.point();
    d.radius = read.length();
  }
  s.polygons = read.lines(kFewestOfPolygon);
  s.walls = read.lines(kFewestOfLine);
  s.movers.resize(read.things());
  for (Mover& m : s.movers) {
    m.center = read.point();
    m.radius_m = read.length();
    m.speed_mps = read.number(kMoverSpeed);
    m.path = read.points(kFewestOfLine);
    if (read.good()) read.demand(is_on_path(m));
  }
  if (!read.good()) return;
  for (const Points& p : s.polygons) read.demand(has_area(p) && !crossing_edges(p));
}

}  // namespace

std::vector<double> flat(const Scenario& s) {
  std::vector<double> list{
      static_cast<double>(s.seed), s.time_limit_s, s.start.at.x, s.start.at.y, s.goal.at.x, s.goal.at.y,
      s.goal.tolerance_m};
  list.push_back(s.bounds ? 1 : 0);
  if (s.bounds) list.insert(list.end(), {s.bounds->min.x, s.bounds->min.y, s.bounds->max.x, s.bounds->max.y});
  list.push_back(static_cast<double>(s.discs.size()));
  for (const sim::Disc& d : s.discs) list.insert(list.end(), {d.center.x, d.center.y, d.radius});
  add(list, s.polygons);
  add(list, s.walls);
  list.push_back(static_cast<double>(s.movers.size()));
  for (const Mover& m : s.movers) {
    list.insert(list.end(), {m.center.x, m.center.y, m.radius_m, m.speed_mps});
    add(list, m.path);
  }
  const Noise& n = s.noise;
  list.insert(list.end(), {n.range_sigma_m, n.range_dropout, n.range_false_clear, n.wheel_scale_sigma,
                           n.heading_drift_deg_per_sqrt_m});
  return list;
}

std::optional<Scenario> scenario_of(const std::vector<double>& list) {
  Reader read(list);
  Scenario s;
  s.seed = static_cast<std::uint64_t>(read.whole(kSeed));
  s.time_limit_s = read.number(kTimeLimit);
  s.start.at = read.point();
  s.goal.at = read.point();
  s.goal.tolerance_m = read.length();
  s.start.heading = bearing(s.start.at, s.goal.at);
  if (read.number({0, 1}) > 0) {
    const sim::Vec2 min = read.point();
    s.bounds = Bounds{min, read.point()};
    read.demand(is_sound(*s.bounds));
  }
  read_obstacles(read, s);
  s.noise.range_sigma_m = read.number(kRangeSigma);
  s.noise.range_dropout = read.number(kProbability);
  s.noise.range_false_clear = read.number(kProbability);
  s.noise.wheel_scale_sigma = read.number(kWheelScaleSigma);
  s.noise.heading_drift_deg_per_sqrt_m = read.number(kHeadingDrift);
  if (!read.all_good()) return std::nullopt;
  return s;
}

}  // namespace whisker::play
