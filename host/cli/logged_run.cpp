#include "host/cli/logged_run.hpp"

#include <cmath>
#include <limits>

#include "firmware/apps/command_hash.hpp"
#include "host/run/make_record.hpp"
#include "host/run/spec.hpp"

namespace whisker::cli {
namespace {

sim::Vec2 metres(const Vec& v) { return {v.x.raw() * 1e-6, v.y.raw() * 1e-6}; }

/// Differences of wrapping 24-bit counters.
std::int32_t change(std::uint32_t from, std::uint32_t to) {
  constexpr auto kHalf = static_cast<std::int32_t>(hal::kEncoderModulus / 2);
  const auto forward = static_cast<std::int32_t>((to - from) % hal::kEncoderModulus);
  return forward < kHalf ? forward : forward - 2 * kHalf;
}

}  // namespace

void LoggedRun::begin(const can::Mission& mission, const Params& params) {
  scenario_ = {};
  scenario_.name = name_;
  scenario_.start = {metres(mission.start.at), radians(mission.start.heading)};
  scenario_.goal = {metres(mission.goal.at), mission.goal.tolerance.raw() * 1e-6};
  scenario_.robot = params;
  records_.clear();
}

const TickRecord& LoggedRun::step(const can::InputSet& set, const Status& status,
                                  const RecordingGuide* guide) {
  if (records_.empty()) first_tick_ = set.tick;
  const double period_s = set.period_ms * 1e-3;
  TickRecord r = make_record(status, guide, set.ranges, (set.tick - first_tick_) * period_s);
  r.x_m = r.est_x_m;
  r.y_m = r.est_y_m;
  r.heading_rad = r.est_heading_rad;
  if (!records_.empty() && set.counts_valid) {
    const double elapsed_s = r.t_s - records_.back().t_s;
    const double metres_a_count = 1.0 / scenario_.robot.wheels.counts_per_metre;
    r.v_left_mps = change(counts_.left, set.counts.left) * metres_a_count / elapsed_s;
    r.v_right_mps = change(counts_.right, set.counts.right) * metres_a_count / elapsed_s;
  }
  if (set.counts_valid) counts_ = set.counts;
  fault_ = status.health.fault;
  outcome_ = status.decision.outcome;
  records_.push_back(r);
  scenario_.time_limit_s = r.t_s;
  return records_.back();
}

RunResult LoggedRun::result() const {
  RunResult result;
  if (fault_ != Fault::none) {
    result.verdict = Verdict::fault;
    result.detail = name(fault_);
  } else if (const auto verdict = verdict_of(outcome_)) {
    result.verdict = *verdict;
    result.detail = planning::name(records_.back().why);
  } else {
    result.detail = "log_ends";
  }
  CommandHash hash;
  sim::Vec2 before = scenario_.start.at;
  for (const TickRecord& r : records_) {
    hash.add(r.command);
    const sim::Vec2 at{r.x_m, r.y_m};
    const sim::Vec2 step = at - before;
    result.path_m += std::sqrt(sim::dot(step, step));
    before = at;
  }
  const sim::Vec2 left = scenario_.goal.at - before;
  result.final_distance_m = std::numeric_limits<double>::quiet_NaN();
  result.believed_distance_m = std::sqrt(sim::dot(left, left));
  result.min_clearance_m = kEmptyWorldClearance;
  result.time_s = scenario_.time_limit_s;
  result.ticks = records_.size();
  result.hash = hash.value();
  return result;
}

}  // namespace whisker::cli
