#include "host/campaign/meeting.hpp"

#include <cmath>

#include "host/run/runner.hpp"
#include "host/run/sim_world.hpp"
#include "host/run/spec.hpp"
#include "host/sim/cone.hpp"
#include "host/sim/elementary.hpp"

namespace whisker::campaign {
namespace {

constexpr double kOff = 0.03;  // m, tolerance between a cone's reading and the nearest point

/// Whether the beams detect the only mover in the world, and since when.
class Sighting {
 public:
  explicit Sighting(const Scenario& scenario) : world_(scenario), spec_(robot_spec(scenario)) {}

  void add(const TickRecord& r) {
    const sim::Pose pose{{r.x_m, r.y_m}, r.heading_rad};
    const double near = sim::clearance(world_.view(), pose.at, r.t_s, 0) - spec_.offset + kOff;
    double range = kSeenWithin;
    for (int beam = -1; beam <= 1; ++beam) {
      const sim::SinCos axis = sim::sin_cos(pose.heading + beam * spec_.side_angle);
      const sim::SinCos half = sim::sin_cos(spec_.cone_half_width);
      const sim::Vec2 direction{axis.cos, axis.sin};
      const sim::Cone cone{pose.at + direction * spec_.offset, direction, half.cos, half.sin};
      range = std::fmin(range, sim::range(cone, world_.view(), r.t_s, kSeenWithin));
    }
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

}  // namespace

Meeting meet(const Scenario& scenario, PlannerKind planner) {
  Meeting m;
  Sighting sighting(scenario);
  double before = 0;
  double now = 0;
  RunOptions options;
  options.planner = planner;
  options.observe = [&](const TickRecord& r) {
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
