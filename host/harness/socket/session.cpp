#include "host/harness/socket/session.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "firmware/can/value_names.hpp"
#include "firmware/math/region.hpp"
#include "host/harness/run/core_pilot.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/run/pilot.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/sim/elementary.hpp"
#include "host/harness/sim/si.hpp"

namespace whisker::socket {
namespace {

using Json = nlohmann::ordered_json;

using sim::si;

double degrees(Angle a) { return std::round(radians(a) * (180 / sim::kPi) * 1e4) / 1e4; }
double speed(std::int16_t tenths) { return tenths / 1e4; }

const char* outcome_name(const Status& status) {
  if (status.health.fault != Fault::none) return "fault";
  switch (status.decision.outcome) {
    case planning::Outcome::none: break;
    case planning::Outcome::running: return "running";
    case planning::Outcome::reached: return "reached";
    case planning::Outcome::unreachable: return "unreachable";
    case planning::Outcome::gave_up: return "gave_up";
  }
  return "idle";
}

Json beam_json(const RangefinderParams& r, int beam) {
  const Mount m = mount(r, beam);
  Json json;
  json["x_m"] = si(m.apex.x);
  json["y_m"] = si(m.apex.y);
  json["angle_deg"] = degrees(m.axis);
  json["cone_deg"] = degrees(beam_cone(r, beam));
  json["min_m"] = si(r.min_range);
  json["max_m"] = si(r.max_range);
  return json;
}

Json pose_json(const Pose& pose) {
  Json json;
  json["x_m"] = si(pose.at.x);
  json["y_m"] = si(pose.at.y);
  json["heading_deg"] = degrees(pose.heading);
  return json;
}

Json sigma_json(const localization::PoseSigma& sigma) {
  Json json;
  json["along_m"] = si(sigma.along);
  json["across_m"] = si(sigma.across);
  json["heading_deg"] = degrees(sigma.heading);
  return json;
}

/// As the documents name it.
std::string_view public_name(PlannerKind kind) {
  const std::string_view other = alias(kind);
  return other.empty() ? name(kind) : other;
}

const char* source_name(localization::HeadingSource source) {
  return can::word_in<can::kHeadingWords>(static_cast<std::int64_t>(source));
}

}  // namespace

struct Session::Core {
  explicit Core(const Opening& opening)
      : params(opening.robot),
        planner(make_planner(opening.planner, params)),
        robot(board, board, *planner, params, &board, &board) {
    robot.place(fixed_pose(opening.start));
    if (opening.goal) aim(*opening.goal);
  }
  void aim(const Goal& at) {
    goal = at;
    robot.set_goal(fixed_goal(at));
  }

  Params params;
  std::shared_ptr<planning::Planner> planner;
  Board board;
  Robot robot;
  std::optional<Goal> goal;
  CommandHash hash;
  std::uint64_t ticks = 0;
};

Session::Session(const Opening& defaults, std::string version)
    : defaults_(defaults), version_(std::move(version)) {}

std::string Session::answer(const std::string& line, std::uint32_t now_ms) {
  ++lines_;
  try {
    if (!core_) {
      last_answer_ = greet(read_opening(line, defaults_));
      opening_ = line;
    }
    if (!last_ms_ && line == opening_) return last_answer_;
    const Tick tick = read_tick(line);
    return step(tick, tick.now_ms.value_or(now_ms));
  } catch (const ProtocolError& e) {
    throw ProtocolError(fmt::format("line {}: {}", lines_, e.what()));
  }
}

std::string Session::greet(const Opening& opening) {
  core_ = std::make_shared<Core>(opening);
  const Params& p = core_->params;
  Json json;
  json["whisker"] = kProtocol;
  json["version"] = version_;
  json["planner"] = public_name(opening.planner);
  json["period_s"] = si(p.safety.period);
  json["longest_gap_s"] = si(longest_gap(p));
  json["body_radius_m"] = si(p.body.radius);
  json["wheel_track_m"] = si(p.body.track);
  json["encoder_counts_per_m"] = p.wheels.counts_per_metre;
  json["wheel_speed_max_mps"] = si(p.wheels.max_speed);
  json["wheel_acceleration_max_mps2"] = si(p.wheels.max_acceleration);
  json["motor_lag_s"] = si(p.wheels.motor_lag);
  json["range_rate_hz"] = p.rangefinders.rate_hz;
  json["range_latency_s"] = si(p.rangefinders.latency);
  if (p.gyro.fitted == Fitted::yes) {
    json["gyro"] = {{"rate_hz", p.gyro.rate_hz}, {"range_radps", si(p.gyro.range)}};
  }
  for (int i = 0; i < hal::kBeams; ++i) json["beams"].push_back(beam_json(p.rangefinders, i));
  return json.dump();
}

std::string Session::step(const Tick& tick, std::uint32_t now_ms) {
  if (tick.now_ms && last_ms_ == now_ms) return last_answer_;
  Core& core = *core_;
  core.board.take(tick, now_ms);
  if (tick.reset) core.robot.reset();
  if (tick.cancel) core.robot.cancel();
  if (tick.place && !core.robot.place(fixed_pose(*tick.place)))
    throw ProtocolError("'place' lies outside the region");
  if (tick.fix && !within(tick.fix->pose.at, kPlaceLimit))
    throw ProtocolError("'fix' lies outside the region");
  if (tick.goal) core.aim(*tick.goal);
  const Status& status = core.robot.tick(Time::from_raw(now_ms));
  std::optional<bool> fixed;
  if (tick.fix) fixed = core.robot.correct(tick.fix->pose, tick.fix->sigma);
  core.hash.add(status.command);
  ++core.ticks;
  Json json;
  json["t_s"] = now_ms / 1e3;
  json["wheel_mps"] = {speed(status.command.left), speed(status.command.right)};
  json["outcome"] = outcome_name(status);
  json["state"] = planning::name(status.decision.mode);
  json["why"] = planning::name(status.decision.why);
  json["fault"] = name(status.health.fault);
  json["pose"] = pose_json(status.pose);
  if (status.sigma_known) json["sigma"] = sigma_json(status.sigma);
  if (core.params.gyro.fitted == Fitted::yes) json["heading_source"] = source_name(status.heading_source);
  if (fixed) {
    json["fix"] = {
        {"accepted", *fixed}, {"jumps", status.health.fix_jumps}, {"refused", status.health.fixes_refused}};
  }
  last_ms_ = now_ms;
  last_answer_ = json.dump();
  return last_answer_;
}

std::optional<SessionEnd> Session::result() const {
  if (!core_ || !last_ms_) return std::nullopt;
  const Status& status = core_->robot.status();
  const planning::Decision& decision = status.decision;
  SessionEnd end{outcome_name(status), {}};
  RunResult& result = end.run;
  if (status.health.fault != Fault::none) {
    result.verdict = Verdict::fault;
    result.detail = name(status.health.fault);
  } else {
    const bool goalless = decision.outcome == planning::Outcome::none && decision.why == planning::Why::none;
    result.verdict = verdict_of(decision.outcome).value_or(Verdict::gave_up);
    result.detail = goalless ? "no_goal" : planning::name(decision.why);
  }
  result.time_s = *last_ms_ / 1e3;
  if (status.sigma_known) result.sigma = status.sigma;
  if (core_->goal) {
    result.goal_tolerance_m = core_->goal->tolerance_m;
    const sim::Vec2 rest = core_->goal->at - sim::Vec2{si(status.pose.at.x), si(status.pose.at.y)};
    result.believed_distance_m = std::sqrt(sim::dot(rest, rest));
  }
  // The world of another simulator is not known here.
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  result.final_distance_m = result.min_clearance_m = result.path_m = kUnknown;
  result.ticks = core_->ticks;
  result.hash = core_->hash.value();
  return end;
}

}  // namespace whisker::socket
