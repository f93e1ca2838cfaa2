#include "host/harness/run/make_record.hpp"

#include "host/harness/run/spec.hpp"

namespace whisker {

TickRecord make_record(const Status& status, const RecordingGuide* guide, const hal::RangeReadings& ranges,
                       double t_s) {
  TickRecord r;
  r.t_s = t_s;
  r.ranges = ranges;
  r.mode = status.decision.mode;
  r.why = status.decision.why;
  r.danger_count = status.decision.danger_count;
  r.looked = status.decision.looked;
  r.d_q7 = status.decision.inputs.distance.raw();
  r.r_q7 = status.decision.inputs.bias.raw();
  r.sa_q14 = status.decision.response.turn.raw();
  r.sd_q14 = status.decision.response.step.raw();
  r.bend_rad = radians(status.decision.bend);
  r.pace_mps = status.pace.raw() * 1e-6;
  r.cell = status.decision.response.cell;
  r.command = status.command;
  r.est_x_m = status.pose.at.x.raw() * 1e-6;
  r.est_y_m = status.pose.at.y.raw() * 1e-6;
  r.est_heading_rad = radians(status.pose.heading);
  if (status.sigma_known) r.sigma = status.sigma;
  if (guide != nullptr) {
    r.guide = guide->said();
    if (has_place(r.guide)) {
      r.way_x_m = guide->way().x.raw() * 1e-6;
      r.way_y_m = guide->way().y.raw() * 1e-6;
    }
  }
  return r;
}

void add_truth(const sim::Plant& plant, TickRecord& record) {
  record.x_m = plant.pose().at.x;
  record.y_m = plant.pose().at.y;
  record.heading_rad = plant.pose().heading;
  record.v_left_mps = plant.v_left();
  record.v_right_mps = plant.v_right();
}

std::optional<Verdict> verdict_of(planning::Outcome outcome) {
  switch (outcome) {
    case planning::Outcome::reached: return Verdict::reached;
    case planning::Outcome::unreachable: return Verdict::unreachable;
    case planning::Outcome::gave_up: return Verdict::gave_up;
    case planning::Outcome::none:
    case planning::Outcome::running: break;
  }
  return std::nullopt;
}

}  // namespace whisker
