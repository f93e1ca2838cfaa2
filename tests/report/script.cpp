#include "tests/report/script.hpp"

#include <algorithm>
#include <cmath>

#include "host/lab/report/units.hpp"
#include "tests/report/infinity.hpp"

namespace whisker::testing {
namespace {

using sim::Vec2;

constexpr double kPeriod = 0.01;
constexpr double kPi = 3.141592653589793;

double distance_along(Vec2 from, double heading, const sim::Disc& disc) {
  const Vec2 d{std::cos(heading), std::sin(heading)};
  const double along = dot(disc.center - from, d);
  const double aside = cross(d, disc.center - from);
  if (along < 0 || std::fabs(aside) >= disc.radius) return kInfinity;
  return along - std::sqrt(disc.radius * disc.radius - aside * aside);
}

hal::RangeReading beam(const Scenario& scenario, Vec2 from, double axis) {
  const RangefinderParams& sensor = scenario.robot.rangefinders;
  const double half = report::radians(sensor.cone) / 2;
  double nearest = kInfinity;
  for (int i = -4; i <= 4; ++i)
    for (const sim::Disc& disc : scenario.discs)
      nearest = std::min(nearest, distance_along(from, axis + half * i / 4, disc));
  if (nearest > report::metres(sensor.max_range)) return {0, hal::RangeStatus::clear, 0, 0};
  if (nearest < report::metres(sensor.min_range)) return {0, hal::RangeStatus::too_near, 0, 0};
  return {static_cast<std::uint16_t>(std::lround(nearest * 1000)), hal::RangeStatus::ok, 0, 0};
}

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

class Walker {
 public:
  explicit Walker(const Scenario& scenario) : scenario_(scenario), pose_(scenario.start) {}

  void go(const Leg& leg) {
    const Vec2 way = leg.to - pose_.at;
    const double heading = std::atan2(way.y, way.x);
    const double turn = wrapped(heading - pose_.heading);
    const int turn_ticks = static_cast<int>(std::ceil(std::fabs(turn) / (2 * kPeriod)));
    for (int i = 0; i < turn_ticks; ++i) {
      pose_.heading += turn / turn_ticks;
      tick(planning::Mode::facing, leg, 0, turn > 0 ? 0.14 : -0.14);
    }
    tick(planning::Mode::looking, leg, 0, 0);
    records_.back().looked = true;
    const double length = std::hypot(way.x, way.y);
    const int ticks = static_cast<int>(std::ceil(length / (0.25 * kPeriod)));
    for (int i = 0; i < ticks; ++i) {
      pose_.at = pose_.at + way * (1.0 / ticks);
      tick(leg.mode, leg, 0.25, 0);
    }
  }
  std::vector<TickRecord> take() { return std::move(records_); }

 private:
  void tick(planning::Mode mode, const Leg& leg, double speed, double turning) {
    const double side = report::radians(scenario_.robot.rangefinders.side_angle);
    TickRecord r;
    r.t_s = kPeriod * static_cast<double>(records_.size() + 1);
    r.x_m = r.est_x_m = pose_.at.x;
    r.y_m = r.est_y_m = pose_.at.y;
    r.heading_rad = r.est_heading_rad = pose_.heading;
    for (int i = 0; i < hal::kBeams; ++i)
      r.ranges.beam[i] = beam(scenario_, pose_.at, pose_.heading + side * (1 - i));
    r.v_left_mps = speed - turning;
    r.v_right_mps = speed + turning;
    r.mode = mode;
    r.why = leg.why;
    r.danger_count = static_cast<std::uint8_t>(leg.danger_count);
    r.command = {static_cast<std::int16_t>(std::lround(r.v_left_mps * 10000)),
                 static_cast<std::int16_t>(std::lround(r.v_right_mps * 10000))};
    records_.push_back(r);
  }

  const Scenario& scenario_;
  sim::Pose pose_;
  std::vector<TickRecord> records_;
};

}  // namespace

std::vector<TickRecord> follow(const Scenario& scenario, const std::vector<Leg>& legs) {
  Walker walker(scenario);
  for (const Leg& leg : legs) walker.go(leg);
  return walker.take();
}

RunLog log_of(const Scenario& scenario, const std::vector<TickRecord>& records, const RunResult& result) {
  RunLog log({scenario});
  for (const TickRecord& r : records) log.add({r, Health{}, nullptr});
  log.end(result);
  return log;
}

RunResult result_of(Verdict verdict, const Scenario& scenario, const std::vector<TickRecord>& records) {
  RunResult result;
  result.verdict = verdict;
  result.ticks = records.size();
  result.min_clearance_m = kInfinity;
  Vec2 last = scenario.start.at;
  for (const TickRecord& r : records) {
    const Vec2 at{r.x_m, r.y_m};
    result.time_s = r.t_s;
    result.path_m += std::hypot(at.x - last.x, at.y - last.y);
    for (const sim::Disc& d : scenario.discs)
      result.min_clearance_m =
          std::min(result.min_clearance_m, std::hypot(at.x - d.center.x, at.y - d.center.y) - d.radius -
                                               report::metres(scenario.robot.body.radius));
    last = at;
  }
  result.final_distance_m = std::hypot(last.x - scenario.goal.at.x, last.y - scenario.goal.at.y);
  return result;
}

Scenario garden() {
  Scenario s;
  s.name = "garden: four discs, a wall & <a mover>";
  s.start = {{0.2, 0.4}, 0.35};
  s.goal = {{3.6, 1.9}, 0.10};
  s.bounds = Bounds{{-0.1, -0.1}, {4.1, 2.5}};
  s.discs = {{{1.15, 0.75}, 0.25}, {{2.15, 1.45}, 0.35}, {{2.0, 0.35}, 0.2}, {{3.1, 0.7}, 0.3}};
  s.polygons = {{{0.5, 1.5}, {1.1, 1.4}, {0.9, 2.0}}};
  s.walls = {{{2.9, 1.45}, {3.3, 1.45}, {3.3, 1.25}}};
  s.movers = {{{1.45, 2.2}, 0.1, {{1.3, 2.2}, {2.8, 2.2}}, 0.05}};
  return s;
}

std::vector<TickRecord> garden_run(const Scenario& scenario) {
  using planning::Mode;
  using planning::Why;
  return follow(scenario, {
                              {{0.55, 0.55}},
                              {{0.75, 0.42}, Mode::stepping, Why::table},
                              {{0.95, 0.30}, Mode::stepping, Why::table},
                              {{1.20, 0.32}, Mode::stepping, Why::table},
                              {{1.45, 0.50}},
                              {{1.62, 0.80}},
                              {{1.66, 1.00}, Mode::stepping, Why::narrow},
                              {{1.61, 1.12}, Mode::following, Why::exit_left, 1},
                              {{1.58, 1.26}, Mode::following, Why::same_side, 2},
                              {{1.58, 1.48}, Mode::following, Why::same_side, 3},
                              {{1.62, 1.68}, Mode::following, Why::same_side, 4},
                              {{1.75, 1.88}, Mode::following, Why::same_side, 5},
                              {{1.95, 1.99}, Mode::stepping, Why::narrow},
                              {{2.25, 2.02}},
                              {{2.60, 1.90}, Mode::stepping, Why::table},
                              {{3.52, 1.90}},
                          });
}

}  // namespace whisker::testing
