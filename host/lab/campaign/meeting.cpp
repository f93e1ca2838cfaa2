#include "host/lab/campaign/meeting.hpp"

#include <cmath>

#include "host/harness/run/runner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/sim/cone.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::campaign {
namespace {

constexpr double kOff = 0.03;  // m, tolerance between a cone's reading and the nearest point

/// Whether the beams detect the only mover in the world, and since when.
class Sighting {
 public:
  explicit Sighting(const Scenario& scenario) : world_(scenario), spec_(robot_spec(scenario)) {}

  void add(const TickRecord& r) {
    const sim::Pose pose{{r.x_m, r.y_m}, r.heading_rad};
    const sim::SinCos heading = sim::sin_cos(pose.heading);
    const sim::Vec2 ahead{heading.cos, heading.sin};
    const sim::Vec2 left{-heading.sin, heading.cos};
    double range = kSeenWithin;
    double outermost = 0;
    for (const sim::BeamSpec& beam : spec_.beams) {
      const sim::SinCos axis = sim::sin_cos(pose.heading + beam.angle);
      const sim::SinCos half = sim::sin_cos(beam.cone_half_width);
      const sim::Cone cone{
          pose.at + ahead * beam.x + left * beam.y, {axis.cos, axis.sin}, half.cos, half.sin};
      range = std::fmin(range, sim::range(cone, world_.view(), r.t_s, kSeenWithin));
      outermost = std::fmax(outermost, std::hypot(beam.x, beam.y));
    }
    const double near = sim::clearance(world_.view(), pose.at, r.t_s, 0) - outermost + kOff;
    if (range >= kSeenWithin) not_shown_ = r.t_s;
    if (range >= std::fmin(kSeenWithin, near)) not_near_ = r.t_s;
    now_ = r.t_s;
  }
  double shown_s() const { return now_ - not_shown_; }
  double near_s() const { return now_ - not_near_; }

 private:
  SimWorld world_;
  sim::RobotSpec spec_;
  double not_shown_ = 0;
  double not_near_ = 0;
  double now_ = 0;
};

/// Until the end of the drive if the robot does not come so far.
double arrival_s(const Scenario& alone, double along_m, PlannerKind planner) {
  const sim::SinCos ahead = sim::sin_cos(alone.start.heading);
  double before = 0;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) {
    const TickRecord& r = moment.record;
    if (r.x_m * ahead.cos + r.y_m * ahead.sin < along_m) before = r.t_s;
  };
  run(alone, options);
  return before;
}

}  // namespace

Scenario timed_meeting(worlds::Course course, double speed_mps, std::uint64_t seed, const Scenario& own,
                       PlannerKind planner) {
  const auto equip = [&own](Scenario scenario) {
    scenario.sensor = own.sensor;
    scenario.noise = own.noise;
    return scenario;
  };
  const auto arrival = [&](const Scenario& alone, double along_m) {
    return arrival_s(equip(alone), along_m, planner);
  };
  return equip(worlds::meeting(course, speed_mps, seed, arrival, own.robot));
}

Meeting meet(const Scenario& scenario, PlannerKind planner) {
  Meeting m;
  Sighting sighting(scenario);
  double before = 0;
  double now = 0;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) {
    const TickRecord& r = moment.record;
    sighting.add(r);
    before = now;
    now = std::fabs(r.v_left_mps + r.v_right_mps) / 2;
    m.said = m.said || r.why == planning::Why::something_moves;
  };
  const RunResult result = run(scenario, options);
  m.verdict = result.verdict;
  m.time_s = result.time_s;
  // The last record is that of the contact, with the wheels at rest.
  m.speed_mps = result.verdict == Verdict::contact ? before : 0;
  m.shown_s = sighting.shown_s();
  m.near_s = sighting.near_s();
  return m;
}

void MeetingCount::add(const Meeting& meeting) {
  ++missions;
  if (says_reached(meeting.verdict)) ++reached;
  if (meeting.said) ++said;
  if (meeting.verdict != Verdict::contact) return;
  ++contacts;
  if (meeting.speed_mps <= kMoving) return;
  ++moving;
  if (meeting.shown_s > kInTime) ++shown;
  if (meeting.near_s > kInTime) ++seen;
}

}  // namespace whisker::campaign
