#include "firmware/robot.hpp"

namespace whisker {
namespace {

// A mission that is due for a rest waits this long for a manoeuvre to end before it is interrupted.
constexpr Duration kRestDelay = 15000_ms;
constexpr Duration kLongestRest = 5000_ms;

constexpr planning::Why out_of_range(bool is) noexcept {
  return is ? planning::Why::goal_out_of_range : planning::Why::none;
}

}  // namespace

Robot::Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, planning::Planner& planner,
             const Params& params, hal::Bumper* bumper, hal::Gyro* gyro) noexcept
    : rangefinders_(rangefinders),
      planner_(planner),
      params_(params),
      bumper_(bumper),
      gyro_(gyro),
      localizer_(params, status_, status_.health),
      wheels_(drive),
      supervisor_(params, status_.health) {
  if (check(params) != ParamFault::none) {
    supervisor_.fail(Fault::invalid_params);
    show_fault();
    return;
  }
  localizer_.configure();
  perception_.configure(params);
  warned_speed_.configure(params);
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
    localizer_.move(pose);
  } else {
    localizer_.put_down(pose);
    if (kGyroBuilt) walls_->restart();
    perception_.forget(pose);
    limiter_.reset();
    reflex_.reset();
  }
  if (has_goal_) aim_again();
  return true;
}

bool Robot::correct(const Pose& pose, const localization::PoseSigma& sigma) noexcept {
  if (!placeable(pose) || !localizer_.correct(pose, sigma)) return false;
  if (has_goal_) aim_again();
  return true;
}

/// Parameters that are refused keep no goal anyway.
bool Robot::keeps(Length tolerance) const noexcept {
  return status_.health.fault == Fault::invalid_params || tolerance >= planning::smallest_tolerance(params_);
}

void Robot::aim_again() noexcept {
  Vec at;
  if (aimed(out_of_range(!localizer_.frame().aim_again(at)))) planner_.move_goal(at);
}

bool Robot::aimed(planning::Why refused) noexcept {
  refused_ = refused;
  has_goal_ = refused == planning::Why::none;
  if (!has_goal_) planner_.cancel();
  return has_goal_;
}

bool Robot::set_goal(const planning::Goal& goal) noexcept {
  planning::Goal inside = goal;
  planning::Why refused = out_of_range(!localizer_.frame().aim(goal.at, inside.at));
  if (refused == planning::Why::none && !keeps(goal.tolerance)) refused = planning::Why::tolerance_too_small;
  if (aimed(refused)) planner_.set_goal(inside);
  return has_goal_;
}

void Robot::cancel() noexcept {
  has_goal_ = false;
  refused_ = planning::Why::none;
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
  localizer_.restart_lessons();
  perception_.forget(localizer_.inside());
  limiter_.reset();
  reflex_.reset();
  motion_.begin(planning::stop(), localizer_.inside());
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
  view.pose = localizer_.inside();
  view.travelled_um = localizer_.travelled_um();
  if (kGyroBuilt && status_.sigma_known) view.bound = localization::distance_bound(status_.sigma);
  view.elapsed = elapsed_;
  view.settled = was_settled_;
  view.cut = motion_.cut();
  view.forward = (rolling.left + rolling.right) / 2;
  view.turning = (rolling.right - rolling.left) / 2;
  view.granted = limiter_.granted();
  if (counted) view.raw.counts = localizer_.counts();
  view.raw.by_gyro = status_.heading_source == localization::HeadingSource::gyro;
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
  wheels_.pass(elapsed_, params_);
  supervisor_.expect_wheels(wheels_.state().rolling, elapsed_, gap);
  last_tick_ = now;
  braked_elsewhere_ = false;
}

bool Robot::take_counts() noexcept {
  localization::Localizer::Step step;
  const bool read = wheels_.read(step.counts);
  supervisor_.check_counts(read);
  if (!read) return false;
  hal::GyroReading reading{};
  if (localizer_.has_gyro() && gyro_ != nullptr && gyro_->read(reading)) step.gyro = &reading;
  step.commanded = status_.command.left != 0 || status_.command.right != 0;
  step.since = since_counts_;
  since_counts_ = Duration{};
  using Stepped = localization::Localizer::Stepped;
  const Stepped stepped = localizer_.step(step);
  if (stepped == Stepped::jumped) {
    supervisor_.fail(Fault::encoder_jump, status_.health.encoder_jumps);
    return false;
  }
  if (stepped == Stepped::corrected && has_goal_) aim_again();
  const bool within_region =
      within(status_.pose.at, kBodyLimit) && within(localizer_.inside().at, kBodyLimit);
  if (!supervisor_.faulted() && !within_region) {
    supervisor_.fail(Fault::pose_out_of_range, status_.health.pose_out_of_range);
  }
  supervisor_.check_wheels(localizer_.counts());
  return true;
}

void Robot::perceive(planning::View& view, bool counted) noexcept {
  hal::RangeReadings readings{};
  const bool read = rangefinders_.read(readings);
  view.raw.ranges = readings;
  perception_.sense(read ? &readings : nullptr, last_tick_, view.pose, params_, status_.health);
  status_.echoes = perception_.latest();
  supervisor_.check_ranges(perception_.lost_for(last_tick_));
  if (params_.bumper.fitted == Fitted::yes) take_bumps(view.pose, counted);
  if (supervisor_.faulted()) return;
  perception_.observe({view.pose, last_tick_, view.settled, settled_since_}, params_, view);
  if (kGyroBuilt && params_.walls.straight == Fitted::yes) {
    follow_wall(hal::kLeft, view);
    follow_wall(hal::kRight, view);
  }
  status_.health.ranges = perception_.trust();
  supervisor_.check_trust(perception_.trust().level);
}

void Robot::follow_wall(hal::Beam side, const perception::Percept& percept) noexcept {
  if ((percept.observed >> side & 1U) == 0) return;
  const perception::Beam& beam = percept.observations[side].beam;
  const perception::Echo& echo = status_.echoes.beam[side];
  const Angle edge = beam.axis + (side == hal::kLeft ? beam.half_cone : -beam.half_cone);
  const localization::WallDirection::Echo at{beam.apex + polar(edge, echo.distance),
                                             beam.axis - beam_axis(params_.rangefinders, side)};
  const bool shows = echo.validity == perception::Validity::ok;
  const Angle outward = status_.pose.heading - localizer_.inside().heading;
  localization::WallDirection::Found found;
  if (!walls_->pass(side, shows ? &at : nullptr, params_.walls.direction - outward, found)) return;
  if (localizer_.correct_heading(found.ahead, found.sigma) && has_goal_) aim_again();
}

void Robot::take_bumps(const Pose& pose, bool counted) noexcept {
  hal::BumperReading reading{};
  const bool read = bumper_ != nullptr && bumper_->read(reading);
  supervisor_.check_bumper(read);
  if (read) status_.pressed = reading.pressed & hal::kAllSwitches;
  if (supervisor_.faulted()) return;
  const bool still = counted && localizer_.counts().left == 0 && localizer_.counts().right == 0;
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
  if (decision.lane.opens) perception_.open_lane(decision.lane.from);
  const bool running = decision.outcome == planning::Outcome::running;
  has_goal_ = running;
  if (refused_ != planning::Why::none) {
    decision.outcome = planning::Outcome::gave_up;
    decision.mode = planning::Mode::gave_up;
    decision.why = refused_;
  }
  motion_.begin(decision.manoeuvre, view.pose);
  const bool waits = view.settled && running && decision.manoeuvre.kind == planning::ManoeuvreKind::keep;
  supervisor_.check_look(waits, last_tick_ - settled_since_);
  supervisor_.check_place(view.pose.at, running, elapsed_);
}

/// The planner is not asked meanwhile.
bool Robot::rests_for_gyro() noexcept {
  if (!localizer_.has_gyro()) return false;
  localization::GyroBias& bias = localizer_.gyro_bias();
  const bool resting = resting_for_ > Duration{};
  const bool begins = bias.stands() || bias.due_for() > kRestDelay;
  if (has_goal_ && localizer_.wants_rest() && (resting || begins)) {
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
  if (reflex_.stops()) {
    wheels_.halt();
    return limiter_.stop();
  }
  planning::VelocityRequest request{};
  if (!stands && reflex_.backs()) {
    request = reflex_.request(view.pose, params_);
    if (reflex_.retraces()) return limiter_.retrace(request, wheels_.state(), elapsed_, params_);
  } else if (!stands) {
    request = motion_.request(view.pose, elapsed_, limiter_.held_for(), params_);
  }
  const bool slows = perception_.slows();
  if (slows || perception_.doubts()) {
    const Speed most = warned_speed_.most(request.turning, perception_.readings_err(), slows, params_);
    request.forward = limit(request.forward, most);
  }
  return limiter_.step(request, view.pose, wheels_.state(), perception_.local_grid(), elapsed_, params_);
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
  motion_.settle(paused ? nullptr : &localizer_.counts(), commanded, elapsed_, params_);
  if (!paused)
    supervisor_.check_stall(localizer_.counts(), control::turns_on_wire(speeds), wheels_.state().rolling,
                            elapsed_);
  supervisor_.check_motion(motion_);
  return speeds;
}

void Robot::actuate(WheelPair speeds) noexcept {
  supervisor_.check_command(wheels_.command(speeds));
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
