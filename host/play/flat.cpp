#include "host/play/flat.hpp"

#include "host/scenario/bearing.hpp"

namespace whisker::play {
namespace {

constexpr double kFarthest = 1000;  // m
constexpr double kLongestTime = 1e6;
constexpr double kGreatestSeed = 9007199254740991.0;
constexpr double kFastestMover = 10;
constexpr double kMost = 4096;  // of anything

using Points = std::vector<sim::Vec2>;

void add(std::vector<double>& list, const Points& points) {
  list.push_back(static_cast<double>(points.size()));
  for (const sim::Vec2 p : points) list.insert(list.end(), {p.x, p.y});
}

void add(std::vector<double>& list, const std::vector<Points>& lines) {
  list.push_back(static_cast<double>(lines.size()));
  for (const Points& line : lines) add(list, line);
}

/// Takes one number after the other, and remembers whether all were good.
class Reader {
 public:
  explicit Reader(const std::vector<double>& list) : list_(list) {}

  double number(double low, double high) {
    const double x = at_ < list_.size() ? list_[at_] : low - 1;
    ++at_;
    // Not-a-number is in no range.
    if (x >= low && x <= high) return x;
    good_ = false;
    return low;
  }
  double length() { return number(1e-4, kFarthest); }
  sim::Vec2 point() {
    const double x = number(-kFarthest, kFarthest);
    return {x, number(-kFarthest, kFarthest)};
  }
  std::size_t count(double least) {
    const double n = number(least, kMost);
    return good_ ? static_cast<std::size_t>(n) : 0;
  }
  Points points(double least) {
    Points points(count(least));
    for (sim::Vec2& p : points) p = point();
    return points;
  }
  std::vector<Points> lines(double least) {
    std::vector<Points> lines(count(0));
    for (Points& line : lines) line = points(least);
    return lines;
  }
  bool all_good() const { return good_ && at_ == list_.size(); }

 private:
  const std::vector<double>& list_;
  std::size_t at_ = 0;
  bool good_ = true;
};

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
  s.seed = static_cast<std::uint64_t>(read.number(0, kGreatestSeed));
  s.time_limit_s = read.number(1e-3, kLongestTime);
  s.start.at = read.point();
  s.goal.at = read.point();
  s.goal.tolerance_m = read.length();
  s.start.heading = bearing(s.start.at, s.goal.at);
  if (read.number(0, 1) > 0) {
    const sim::Vec2 min = read.point();
    s.bounds = Bounds{min, read.point()};
  }
  s.discs.resize(read.count(0));
  for (sim::Disc& d : s.discs) {
    d.center = read.point();
    d.radius = read.length();
  }
  s.polygons = read.lines(3);
  s.walls = read.lines(2);
  s.movers.resize(read.count(0));
  for (Mover& m : s.movers) {
    m.center = read.point();
    m.radius_m = read.length();
    m.speed_mps = read.number(0, kFastestMover);
    m.path = read.points(2);
  }
  s.noise.range_sigma_m = read.number(0, 10);
  s.noise.range_dropout = read.number(0, 1);
  s.noise.range_false_clear = read.number(0, 1);
  s.noise.wheel_scale_sigma = read.number(0, 1);
  s.noise.heading_drift_deg_per_sqrt_m = read.number(0, 360);
  if (!read.all_good()) return std::nullopt;
  return s;
}

}  // namespace whisker::play
