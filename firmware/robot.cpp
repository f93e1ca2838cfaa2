#include "firmware/robot.hpp"

#include "firmware/safety/warning.hpp"

namespace whisker {
namespace {

// A mission that is due for a rest waits this long for a manoeuvre to end before it is interrupted.
constexpr Duration kRestDelay = 15000_ms;
constexpr Duration kLongestRest = 5000_ms;

}  // namespace

Robot::Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, planning::Planner& planner,
             const Params& params, hal::Bumper* bumper, hal::Gyro* gyro) noexcept
    : rangefinders_(rangefinders),
      planner_(planner),
      params_(params),
      bumper_(bumper),
      gyro_(gyro),
      wheels_(drive),
      supervisor_(params, status_.health) {
  if (check(params) != ParamFault::none) {
    supervisor_.fail(Fault::invalid_params);
    show_fault();
    return;
  }
  odometry_.configure(params);
  if (has_gyro()) heading_->configure(params, odometry_);
  if (kGyroBuilt) {
    bound_->configure(params);
    teacher_->configure(params, odometry_);
    status_.sigma_known = bound_->known();
    restart_bound({});
  }
  perception_.configure(params);
  warned_speed_ = safety::warned_speed(params);
  supervisor_.configure();
  motion_.configure(params);
}

bool Robot::placeable(const Pose& pose) noexcept {
  if (within(pose.at, kPlaceLimit)) return true;
  supervisor_.fail(Fault::pose_out_of_range, status_.health.pose_out_of_range);
  show_fault();
  return false;
}

bool Robot::place(const Pose& pose) noexcept {
  if (!placeable(pose)) return false;
  if (started_ && !supervisor_.faulted() && has_goal_) {
    if (kGyroBuilt) restart_bound({});
    move_frame(pose);
  } else {
    put_down(pose);
  }
  return true;
}

void Robot::put_down(const Pose& pose) noexcept {
  odometry_.place(pose);
  if (has_gyro()) heading_->restart();
  if (kGyroBuilt) teacher_->restart(Angle{}, Angle{});
  status_.pose = pose;
  perception_.forget(pose);
  guard_.reset();
  reflex_.reset();
  frame_.tie(pose, pose);
  if (kGyroBuilt) restart_bound({});
  if (has_goal_) aim_again();
}

bool Robot::correct(const Pose& pose, const localization::PoseSigma& sigma) noexcept {
  if (!placeable(pose)) return false;
  localization::UncertainPose fix{pose, sigma};
  if (has_bound()) {
    const localization::UncertainPose estimate{status_.pose, bound_->sigma()};
    if (localization::jumps(estimate, fix)) {
      count(status_.health.fix_jumps);
      if (params_.fix_jumps == JumpPolicy::refuse) {
        count(status_.health.fixes_refused);
        return false;
      }
    }
    fix = localization::fused(estimate, fix);
  }
  teach(pose.heading, sigma.heading, fix);
  if (kGyroBuilt) restart_bound(fix.sigma);
  move_frame(fix.pose);
  return true;
}

void Robot::teach(Angle fix, Angle sigma, const localization::UncertainPose& fused) noexcept {
  if (!kGyroBuilt || has_gyro()) return;
  const Angle heading = odometry_.pose().heading;
  if (!teacher_->fix(fix - heading, sigma)) return;
  teacher_->restart(fused.pose.heading - heading, fused.sigma.heading);
  if (has_bound()) bound_->set_difference(teacher_->gains().skew_sigma() * 2, params_.body.track);
}

void Robot::move_frame(const Pose& pose) noexcept {
  if (pose.at == status_.pose.at && pose.heading == status_.pose.heading) return;
  frame_.tie(odometry_.pose(), pose);
  status_.pose = pose;
  if (has_goal_) aim_again();
}

void Robot::aim_again() noexcept {
  Vec at;
  if (aimed(frame_.aim_again(at))) planner_.move_goal(at);
}

bool Robot::aimed(bool in_range) noexcept {
  has_goal_ = in_range;
  goal_refused_ = !in_range;
  if (!in_range) planner_.cancel();
  return in_range;
}

bool Robot::set_goal(const planning::Goal& goal) noexcept {
  planning::Goal inside = goal;
  if (aimed(frame_.aim(goal.at, inside.at))) planner_.set_goal(inside);
  return has_goal_;
}

void Robot::cancel() noexcept {
  has_goal_ = goal_refused_ = false;
  planner_.cancel();
}

void Robot::reset() noexcept {
  if (status_.health.fault == Fault::invalid_params) return;
  supervisor_.reset();
  started_ = false;
  was_settled_ = false;
  resting_for_ = Duration{};
  // The next counts may include the whole braking path.
  since_counts_ += safety::braking_time(params_);
  perception_.forget(odometry_.pose());
  guard_.reset();
  reflex_.reset();
  motion_.begin(planning::stop(), odometry_.pose());
  cancel();
}

const Status& Robot::tick(Time now) noexcept {
  if (status_.health.fault == Fault::invalid_params) {
    actuate({});
    return status_;
  }
  planning::View view;
  const bool counted = localize(now, view);
  perceive(view, counted);
  plan(view);
  actuate(guard(view, !counted));
  return status_;
}

bool Robot::localize(Time now, planning::View& view) noexcept {
  take_time(now);
  const bool counted = take_counts();
  if (motion_.settled() && !was_settled_) settled_since_ = now;
  was_settled_ = motion_.settled();
  const WheelPair rolling = wheels_.state().rolling;
  view.pose = odometry_.pose();
  view.travelled_um = odometry_.travelled_um();
  view.elapsed = elapsed_;
  view.settled = was_settled_;
  view.cut = motion_.cut();
  view.forward = (rolling.left + rolling.right) / 2;
  view.turning = (rolling.right - rolling.left) / 2;
  view.granted = guard_.granted();
  return counted;
}

void Robot::take_time(Time now) noexcept {
  Duration gap = params_.safety.period;
  if (!started_) {
    started_ = true;
    perception_.start(now);
    settled_since_ = now;
  } else {
    const Duration passed = now - last_tick_;
    const bool longer = passed > longest_gap(params_);
    const bool excused = braked_elsewhere_ && passed <= params_.safety.lost_after;
    if (longer && excused) perception_.lose_history();
    supervisor_.check_gap(passed, excused);
    if (passed > Duration{}) gap = passed;
  }
  elapsed_ = min(gap, longest_gap(params_));
  since_counts_ += gap;
  supervisor_.expect_wheels(wheels_.state().rolling, elapsed_, gap);
  last_tick_ = now;
  braked_elsewhere_ = false;
}

bool Robot::take_counts() noexcept {
  hal::EncoderCounts counts{};
  const bool read = wheels_.read(counts);
  supervisor_.check_counts(read);
  if (!read) return false;
  const bool sound = odometry_.take(counts, since_counts_, step_);
  if (sound) advance_pose();
  since_counts_ = Duration{};
  if (!sound) {
    supervisor_.fail(Fault::encoder_jump, status_.health.encoder_jumps);
    return false;
  }
  const Pose inside = odometry_.pose();
  status_.pose = frame_.outward(inside);
  const bool within_region = within(status_.pose.at, kBodyLimit) && within(inside.at, kBodyLimit);
  if (!supervisor_.faulted() && !within_region) {
    supervisor_.fail(Fault::pose_out_of_range, status_.health.pose_out_of_range);
  }
  supervisor_.check_wheels(step_);
  return true;
}

void Robot::advance_pose() noexcept {
  if (!kGyroBuilt) return odometry_.advance(step_);
  if (!has_gyro()) {
    advance_by_wheels();
    if (has_bound()) advance_bound(Duration{});
    return;
  }
  hal::GyroReading reading{};
  const bool read = gyro_ != nullptr && gyro_->read(reading);
  const bool commanded = status_.command.left != 0 || status_.command.right != 0;
  const localization::GyroHeading::Step step{read ? &reading : nullptr, step_, commanded, since_counts_};
  odometry_.advance(step_, heading_->turn(step, odometry_, status_.health));
  status_.heading_source = heading_->source();
  if (has_bound()) advance_bound(heading_->bias().age());
}

void Robot::advance_by_wheels() noexcept {
  teacher_->pass(step_);
  if (!teacher_->taught()) return odometry_.advance(step_);
  odometry_.advance(step_, teacher_->turn(step_, odometry_));
}

void Robot::advance_bound(Duration bias_age) noexcept {
  const bool by_gyro = status_.heading_source == localization::HeadingSource::gyro;
  const Pose pose = odometry_.pose();
  if (bound_->step({pose, step_, since_counts_, by_gyro, bias_age})) status_.sigma = bound_->sigma();
}

void Robot::restart_bound(const localization::PoseSigma& sigma) noexcept {
  if (!has_bound()) return;
  bound_->restart(odometry_.pose(), sigma);
  status_.sigma = bound_->sigma();
}

void Robot::perceive(planning::View& view, bool counted) noexcept {
  hal::RangeReadings readings{};
  const bool read = rangefinders_.read(readings);
  perception_.sense(read ? &readings : nullptr, last_tick_, view.pose.heading, params_, status_.health);
  status_.echoes = perception_.latest();
  supervisor_.check_ranges(perception_.lost_for(last_tick_));
  if (params_.bumper.fitted == Fitted::yes) take_bumps(view.pose, counted);
  if (supervisor_.faulted()) return;
  perception_.observe({view.pose, last_tick_, view.settled, settled_since_}, params_, view);
  status_.health.ranges = perception_.trust();
  supervisor_.check_trust(perception_.trust().level);
}

void Robot::take_bumps(const Pose& pose, bool counted) noexcept {
  hal::BumperReading reading{};
  const bool read = bumper_ != nullptr && bumper_->read(reading);
  supervisor_.check_bumper(read);
  if (read) status_.pressed = reading.pressed & hal::kAllSwitches;
  if (supervisor_.faulted()) return;
  const bool still = counted && step_.left == 0 && step_.right == 0;
  const bool was_active = reflex_.active();
  const uint8_t fresh = reflex_.step(pose, {status_.pressed, has_goal_, still, elapsed_}, params_);
  if (reflex_.active() && !was_active) motion_.interrupt();
  if (fresh != 0) {
    perception_.touch(fresh, pose);
    supervisor_.check_bump(pose.at);
  }
  if (reflex_.stuck(params_)) supervisor_.fail(Fault::bumper_stuck, status_.health.bumper_stuck);
}

void Robot::plan(const planning::View& view) noexcept {
  if (supervisor_.faulted()) return;
  planning::Decision& decision = status_.decision;
  if (reflex_.active()) {
    resting_for_ = Duration{};
    decision.manoeuvre = {};
    decision.why = planning::Why::bumped;
    decision.looked = false;
    return;
  }
  if (rests_for_gyro()) {
    decision.manoeuvre = {};
    decision.mode = planning::Mode::looking;
    decision.why = planning::Why::gyro_rest;
    decision.outcome = planning::Outcome::running;
    decision.looked = false;
    return;
  }
  decision = planner_.step(view);
  if (kNarrowGaps && decision.lane->opens) perception_.open_lane(decision.lane->from);
  const bool running = decision.outcome == planning::Outcome::running;
  has_goal_ = running;
  if (goal_refused_) {
    decision.outcome = planning::Outcome::gave_up;
    decision.mode = planning::Mode::gave_up;
    decision.why = planning::Why::goal_out_of_range;
  }
  motion_.begin(decision.manoeuvre, view.pose);
  const bool waits = view.settled && running && decision.manoeuvre.kind == planning::ManoeuvreKind::keep;
  supervisor_.check_look(waits, last_tick_ - settled_since_);
  supervisor_.check_place(view.pose.at, running, elapsed_);
}

/// The planner is not asked meanwhile.
bool Robot::rests_for_gyro() noexcept {
  if (!has_gyro()) return false;
  localization::GyroBias& bias = heading_->bias();
  const bool resting = resting_for_ > Duration{};
  const bool begins = bias.stands() || bias.due_for() > kRestDelay;
  if (has_goal_ && heading_->wants_rest() && (resting || begins)) {
    if (!resting) motion_.interrupt();
    resting_for_ += elapsed_;
    if (resting_for_ < kLongestRest) return true;
    bias.postpone();
  }
  // The look at the surroundings starts again: a planner that waits for it has only waited since now.
  if (resting) settled_since_ = last_tick_;
  resting_for_ = Duration{};
  return false;
}

WheelPair Robot::granted(const planning::View& view, bool stands) noexcept {
  if (reflex_.stops()) return guard_.stop();
  planning::VelocityRequest request{};
  if (!stands && reflex_.backs()) {
    request = reflex_.request(view.pose, params_);
    if (reflex_.retraces()) return guard_.retrace(request, wheels_.state(), elapsed_, params_);
  } else if (!stands) {
    request = motion_.request(view.pose, elapsed_, guard_.held_for(), params_);
  }
  const bool slows = perception_.slows();
  if (slows || perception_.doubts()) {
    // The warned speed rests on the parameters, which the readings contradict.
    const Speed straight = slows ? min(warned_speed_, params_.wheels.max_speed / 2) : warned_speed_;
    request.forward = limit(request.forward, safety::warned_speed(straight, request.turning));
  }
  return guard_.step(request, view.pose, wheels_.state(), perception_.local_grid(), elapsed_, params_);
}

WheelPair Robot::guard(const planning::View& view, bool paused) noexcept {
  const bool fresh = perception_.lost_for(last_tick_) <= params_.conditioning.stale_after;
  if (!fresh && !supervisor_.faulted() && !reflex_.active() &&
      status_.decision.outcome == planning::Outcome::running) {
    status_.decision.why = planning::Why::blind;
  }
  const bool rests = resting_for_ > Duration{};
  const bool stands = paused || rests || !fresh || supervisor_.faulted() || supervisor_.refused();
  const WheelPair speeds = granted(view, stands);
  const bool commanded = speeds.left != Speed{} || speeds.right != Speed{};
  motion_.settle(paused ? nullptr : &step_, commanded, elapsed_, params_);
  supervisor_.check_motion(motion_);
  return speeds;
}

void Robot::actuate(WheelPair speeds) noexcept {
  supervisor_.check_command(wheels_.command(speeds, elapsed_, params_));
  status_.command = wheels_.sent();
  if (supervisor_.faulted()) show_fault();
}

void Robot::show_fault() noexcept {
  status_.decision.manoeuvre = {};
  status_.decision.mode = planning::Mode::stopped;
  status_.decision.why = planning::Why::fault;
  status_.decision.looked = false;
}

}  // namespace whisker
