#include "host/lab/bench/seat.hpp"

#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"

namespace whisker::bench {
namespace {

std::int32_t micro(double value) {
  return static_cast<std::int32_t>(std::clamp(std::floor(value * 1e6 + 0.5), -2147483647.0, 2147483647.0));
}

}  // namespace

bool Seat::poll(std::uint32_t now_ms) {
  node_.poll(now_ms);
  can::Order order = can::Order::cancel;
  can::Mission mission;
  if (node_.take_order(order, mission)) {
    started_ = started_ || order == can::Order::start;
    on_order(order, mission, node_.params());
  }
  can::InputSet set;
  if (!started_ || !node_.take_set(set)) return false;
  step(set);
  return true;
}

void GoalSeat::on_order(can::Order order, const can::Mission& mission, const Params& params) {
  const can::Mission own{mission.start, goal_};
  robot_->execute(order, own, params);
  if (order == can::Order::start && listener_.begins) listener_.begins(own, params);
}

void GoalSeat::step(const can::InputSet& set) {
  status_ = robot_->step(set, node().braked());
  const bool ends = status_.decision.outcome != planning::Outcome::running;
  node().publish_trust(can_app::trust_report(status_.health.ranges), ends);
  if (status_.sigma_known) node().publish_sigma(can_app::sigma_report(status_), ends);
  if (set.has_fix) node().answer_fix(can_app::fix_reply(robot_->fix_status(), status_.health));
  node().answer(status_.command, can_app::nav_status(status_));
  const bool failed = status_.health.fault != Fault::none;
  node().report(failed ? std::uint16_t{can::Error::core_fault} : std::uint16_t{0},
                static_cast<std::uint8_t>(status_.health.fault));
  if (listener_.stepped) listener_.stepped(set, status_);
}

void GuardSeat::on_order(can::Order order, const can::Mission&, const Params& params) {
  if (order == can::Order::start) {
    params_ = params;
    board_ = {};
    guard_.emplace(board_, board_, params_, &board_);
    first_tick_.reset();
  } else if (guard_) {
    guard_->reset();
  }
  if (guard_ && vouched_m_ > 0 && order == can::Order::start) {
    guard_->vouch(Length::from_raw(micro(vouched_m_)));
  }
}

void GuardSeat::step(const can::InputSet& set) {
  if (!first_tick_) first_tick_ = set.tick;
  time_s_ = (set.tick - *first_tick_) * (set.period_ms * 1e-3);
  const Time now = Time::from_raw(set.tick * set.period_ms);
  board_.on_frame(set, node().braked());
  if (ended_ || time_s_ >= next_s_) {
    const Pose& pose = status_.pose;
    const sim::Pose seen{{pose.at.x.raw() * 1e-6, pose.at.y.raw() * 1e-6}, radians(pose.heading)};
    const guard::Twist twist = ended_ ? guard::Twist{} : hand_.ask({seen, time_s_});
    guard_->command(
        {Speed::from_raw(micro(twist.forward_mps)), AngularRate::from_raw(micro(twist.turning_radps))}, now);
    next_s_ = time_s_ + hand_.pause_s();
  }
  status_ = guard_->tick(now);
  const bool failed = status_.health.fault != Fault::none;
  can::NavStatus told;
  told.outcome = failed || (ended_ && stands()) ? planning::Outcome::gave_up : planning::Outcome::running;
  told.state = failed ? planning::Mode::stopped : planning::Mode::steering;
  told.why = failed ? planning::Why::fault : ended_ ? planning::Why::cancelled : planning::Why::table;
  told.fault = static_cast<std::uint8_t>(status_.health.fault);
  node().answer(status_.command, told);
  node().report(failed ? std::uint16_t{can::Error::core_fault} : std::uint16_t{0}, told.fault);
}

}  // namespace whisker::bench
