#include "firmware/robot.hpp"

namespace whisker {

Robot::Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, nav::Planner& planner,
             const Params& params) noexcept
    : rangefinders_(rangefinders), drive_(drive), planner_(planner), params_(params) {
  if (!kParamsAreTrusted && check(params) != ParamFault::none) {
    fail(Fault::invalid_params);
    return;
  }
  odometry_.configure(params);
  mapper_.configure(params);
}

void Robot::place(const Pose& pose) noexcept {
  odometry_.place(pose);
  status_.pose = pose;
  mapper_.place(pose);
}

void Robot::set_goal(const nav::Goal& goal) noexcept { planner_.set_goal(goal); }

void Robot::cancel() noexcept { planner_.cancel(); }

void Robot::reset() noexcept {
  if (status_.health.fault == Fault::invalid_params) return;
  status_.health.fault = Fault::none;
  started_ = false;
  drive_refusals_ = 0;
  encoder_refusals_ = 0;
  was_settled_ = false;
  driver_.begin({nav::Kind::stop, {}, {}}, status_.pose);
  planner_.cancel();
}

const Status& Robot::tick(Time now) noexcept {
  if (status_.health.fault == Fault::invalid_params) {
    status_.command = {};
    if (!drive_.command(status_.command)) count(status_.health.drive_refused);
    return status_;
  }
  check_clock(now);
  sense(now);
  motion::CountStep counts;
  const bool measured = measure(counts);
  if (driver_.settled() && !was_settled_) settled_since_ = now;
  was_settled_ = driver_.settled();
  navigate();
  drive(measured ? &counts : nullptr);
  return status_;
}

void Robot::check_clock(Time now) noexcept {
  if (!started_) {
    started_ = true;
    conditioner_.reset(now);
    settled_since_ = now;
  } else {
    const Duration gap = now - last_tick_;
    if (gap <= Duration{} || gap > params_.safety.max_gap) {
      count(status_.health.clock_jumps);
      fail(Fault::clock_jump);
    } else if (gap > params_.safety.period + params_.safety.period / 2) {
      count(status_.health.late_ticks);
    }
  }
  last_tick_ = now;
}

void Robot::sense(Time now) noexcept {
  hal::RangeReadings readings{};
  const bool read = rangefinders_.read(readings);
  if (!read) count(status_.health.range_refused);
  conditioner_.update(read ? &readings : nullptr, now, odometry_.pose().heading, params_, status_.health);
  status_.echoes = conditioner_.latest();
  const Duration lost = conditioner_.lost_for(now);
  beams_fresh_ = lost <= params_.conditioning.stale_after;
  if (lost > params_.safety.lost_after) fail(Fault::range_lost);
}

bool Robot::measure(motion::CountStep& step) noexcept {
  hal::EncoderCounts counts{};
  if (!drive_.read(counts)) {
    count(status_.health.encoder_refused);
    if (++encoder_refusals_ >= params_.safety.max_refusals) fail(Fault::drive_refused);
    return false;
  }
  encoder_refusals_ = 0;
  if (!odometry_.update(counts, step)) {
    count(status_.health.encoder_jumps);
    fail(Fault::encoder_jump);
    return false;
  }
  status_.pose = odometry_.pose();
  return true;
}

void Robot::navigate() noexcept {
  if (faulted()) return;
  const bool settled = driver_.settled();
  nav::View view;
  view.pose = status_.pose;
  view.settled = settled;
  if (settled) view.look = conditioner_.look(settled_since_, params_);
  const motion::WheelPair rolling = driver_.wheels().rolling;
  view.forward = (rolling.left + rolling.right) / 2;
  view.turning = (rolling.right - rolling.left) / 2;
  Mapper::Proofs proofs{};
  mapper_.observe({status_.pose, last_tick_, settled, settled_since_}, conditioner_, params_, proofs, view);
  status_.decision = planner_.step(view);
  mapper_.guard(status_.decision.manoeuvre, status_.pose, driver_.wheels(), params_);
  driver_.begin(status_.decision.manoeuvre, status_.pose);
  if (!beams_fresh_ && status_.decision.outcome == nav::Outcome::running) {
    status_.decision.why = nav::Why::blind;
  }
  watch_look(settled);
}

void Robot::watch_look(bool settled) noexcept {
  const bool waits = settled && status_.decision.outcome == nav::Outcome::running &&
                     status_.decision.manoeuvre.kind == nav::Kind::keep;
  // Each reading that a look needs may take `lost_after` before the beam is lost, and one is under way.
  const Duration longest = params_.safety.lost_after * (params_.conditioning.reads + 1);
  if (waits && last_tick_ - settled_since_ > longest) {
    count(status_.health.unsteady_looks);
    fail(Fault::range_unsteady);
  }
}

bool Robot::overdue(int32_t ticks) const noexcept {
  return params_.safety.period * ticks > params_.safety.stalled_after;
}

void Robot::watch_driver() noexcept {
  if (faulted()) return;
  if (overdue(driver_.stalled_ticks())) {
    count(status_.health.wheel_stalls);
    fail(Fault::wheels_stalled);
  } else if (overdue(driver_.waiting_ticks())) {
    count(status_.health.no_progress);
    fail(Fault::no_progress);
  }
}

void Robot::drive(const motion::CountStep* counts) noexcept {
  const bool paused = faulted() || !beams_fresh_ || drive_refusals_ > 0 || counts == nullptr;
  const motion::WheelPair speeds = driver_.step(status_.pose, counts, paused, params_);
  watch_driver();
  status_.command = motion::to_wire(speeds);
  if (drive_.command(status_.command)) {
    drive_refusals_ = 0;
    return;
  }
  count(status_.health.drive_refused);
  driver_.halt();
  status_.command = {};
  if (++drive_refusals_ >= params_.safety.max_refusals) fail(Fault::drive_refused);
}

void Robot::show_fault() noexcept {
  status_.decision.manoeuvre = {};
  status_.decision.mode = nav::Mode::stopped;
  status_.decision.why = nav::Why::fault;
  status_.decision.looked = false;
}

void Robot::fail(Fault fault) noexcept {
  if (faulted()) return;
  status_.health.fault = fault;
  show_fault();
}

}  // namespace whisker
