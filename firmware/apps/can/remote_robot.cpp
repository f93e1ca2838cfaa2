#include "firmware/apps/can/remote_robot.hpp"

namespace whisker::can_app {

void RemoteRobot::execute(can::Order order, const can::Mission& mission, const Params& params) noexcept {
  const Length length = norm(mission.goal.at - mission.start.at);
  if (order != can::Order::resume && can::drives(order)) {
    params_ = params;
    if (calibrator_ != nullptr) calibrator_->apply(params_);
  }
  switch (order) {
    case can::Order::start:
      if (calibrator_ != nullptr) calibrator_->abandon();
      begin(planners_.make(params_), mission);
      break;
    case can::Order::spin:
      if (calibrator_ != nullptr) begin(calibrator_->spin(params_), mission);
      break;
    case can::Order::straight:
      if (calibrator_ != nullptr) begin(calibrator_->straight(params_, length), mission);
      break;
    case can::Order::tape:
      if (calibrator_ != nullptr) begin(calibrator_->tape(params_, length), mission);
      break;
    case can::Order::measured:
      if (calibrator_ != nullptr) calibrator_->take_tape(length);
      break;
    case can::Order::cancel:
      if (ready()) robot_->cancel();
      break;
    case can::Order::resume:
      if (!ready()) break;
      robot_->reset();
      if (calibrator_ != nullptr) calibrator_->begin_anew();
      robot_->set_goal(mission.goal);
      break;
  }
}

void RemoteRobot::execute_operator(can::Order order, const planning::Goal& goal,
                                   const Params& params) noexcept {
  if (order == can::Order::start) {
    execute(order, {robot_->status().pose, goal}, params);
  } else if (order == can::Order::cancel) {
    robot_->cancel();
  } else {
    robot_->set_goal(goal);
  }
}

void RemoteRobot::begin(planning::Planner& planner, const can::Mission& mission) noexcept {
  board_ = RemoteBoard{};
  robot_ = &room_.make<Robot>(board_, board_, planner, params_, &board_, &board_);
  robot_->place(mission.start);
  robot_->set_goal(mission.goal);
}

const Status& RemoteRobot::step(const can::InputSet& set, bool braked) noexcept {
  board_.on_frame(set, braked);
  if (braked) robot_->braked_elsewhere();
  const Status& status = robot_->tick(Time::from_raw(set.tick * set.period_ms));
  if (set.has_fix) {
    const bool placeable = within(set.fix.pose.at, kPlaceLimit);
    const bool taken = robot_->correct(set.fix.pose, set.fix.sigma);
    fix_status_ = taken       ? can::FixStatus::accepted
                  : placeable ? can::FixStatus::refused
                              : can::FixStatus::out_of_range;
  }
  return status;
}

can::NavStatus nav_status(const Status& s) noexcept {
  can::NavStatus n;
  n.outcome = s.decision.outcome;
  n.state = s.decision.mode;
  n.looked = s.decision.looked ? 1 : 0;
  n.why = s.decision.why;
  n.danger = s.decision.danger_count;
  n.fault = static_cast<uint8_t>(s.health.fault);
  return n;
}

can::RangeTrustReport trust_report(const RangeTrust& trust) noexcept {
  return {trust.level, trust.contradictions, static_cast<uint8_t>(trust.phantoms >> 8),
          static_cast<uint8_t>(trust.false_clears >> 8), trust.incidence_deg};
}

can::PoseSigmaReport sigma_report(const localization::Estimate& s) noexcept {
  const auto mm = [](Length x) { return static_cast<uint16_t>((x.raw() + 999) / 1000); };
  return {static_cast<uint8_t>(s.heading_source), mm(s.sigma.along), mm(s.sigma.across),
          static_cast<uint16_t>((s.sigma.heading.raw() + 65535) >> 16)};
}

can::FixReply fix_reply(can::FixStatus status, const Health& health) noexcept {
  const auto counted = [](uint32_t n) { return static_cast<uint16_t>(n < UINT16_MAX ? n : UINT16_MAX); };
  return {status, 0, counted(health.fix_jumps), counted(health.fixes_refused)};
}

}  // namespace whisker::can_app
