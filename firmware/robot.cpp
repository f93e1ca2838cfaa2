#include "firmware/robot.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker {
namespace {

#ifndef WHISKER_SMALL
// What the wheels still do from before a reset is no one's command.
constexpr Duration kUnwatched = 500_ms;
constexpr Length kPlace = 30_mm;  // for the reference body
// In one place it may wait this many times stalled_after, turn around this often, and cross it this often.
constexpr int32_t kWaits = 60;
constexpr int32_t kTurns = 30;
constexpr int32_t kSteps = 30;

/// Braking from full speed, until the wheels have followed.
Duration braking_time(const Params& p) noexcept {
  return milliseconds(multiply_divide(p.wheels.max_speed.raw(), 1000, p.wheels.max_acceleration.raw())) +
         p.wheels.motor_lag * 4;
}

Duration ms_at(Length way, int32_t times, Speed speed) noexcept {
  return milliseconds(multiply_divide(way.raw(), 1000 * times, speed.raw()));
}

/// What is done in one place takes less than this.
Duration longest_stay(const Params& p) noexcept {
  constexpr int32_t kMicroradians = 6283185;  // a turn
  const AngularRate rate = min(p.wheels.max_turn_rate, planning::kFastestTurn);
  const Duration turn = max(milliseconds(multiply_divide(kMicroradians, 1000, rate.raw())),
                            ms_at(p.body.track * 22 / 7, 1, p.wheels.max_speed));
  return p.safety.stalled_after * kWaits + turn * kTurns +
         ms_at(for_body(p, kPlace), kSteps, p.wheels.max_speed);
}
#endif

}  // namespace

Robot::Robot(hal::Rangefinders& rangefinders, hal::Drive& drive, planning::Planner& planner,
             const Params& params) noexcept
    : rangefinders_(rangefinders), drive_(drive), planner_(planner), params_(params) {
  if (!kParamsAreTrusted && check(params) != ParamFault::none) {
    fail(Fault::invalid_params);
    return;
  }
  odometry_.configure(params);
  perception_.configure(params);
#ifndef WHISKER_SMALL
  wheel_watch_.configure(params);
  longest_stay_ = longest_stay(params);
#endif
}

bool Robot::place(const Pose& pose) noexcept {
  if (kCorrects && !within(pose.at, kPlaceLimit)) {
    leave_region();
    return false;
  }
  if (!started_ || faulted() || !has_goal_) {
    put_down(pose);
    return true;
  }
  if constexpr (kCorrects) correct(pose);
  return kCorrects;
}

void Robot::put_down(const Pose& pose) noexcept {
  odometry_.place(pose);
  status_.pose = pose;
  perception_.place(pose);
  if constexpr (kCorrects) {
    frame_.tie(pose, pose);
    if (has_goal_) aim_again();
  }
}

void Robot::correct(const Pose& pose) noexcept {
  if (pose.at == status_.pose.at && pose.heading == status_.pose.heading) return;
  frame_.tie(odometry_.pose(), pose);
  status_.pose = pose;
  aim_again();
}

#ifndef WHISKER_SMALL
void Robot::aim_again() noexcept {
  Vec at;
  has_goal_ = frame_.aim_again(at);
  goal_refused_ = !has_goal_;
  if (has_goal_) {
    planner_.move_goal(at);
  } else {
    planner_.cancel();
  }
}
#endif

bool Robot::set_goal(const planning::Goal& goal) noexcept {
  planning::Goal inside = goal;
  has_goal_ = frame_.aim(goal.at, inside.at);
  goal_refused_ = !has_goal_;
  if (has_goal_) {
    planner_.set_goal(inside);
  } else {
    planner_.cancel();
  }
  return has_goal_;
}

void Robot::cancel() noexcept {
  has_goal_ = goal_refused_ = false;
  planner_.cancel();
}

void Robot::reset() noexcept {
  if (status_.health.fault == Fault::invalid_params) return;
  status_.health.fault = Fault::none;
  started_ = false;
  drive_refusals_.reset();
  encoder_refusals_.reset();
  was_settled_ = false;
#ifndef WHISKER_SMALL
  // The next counts may tell of the whole way to rest.
  since_counts_ += braking_time(params_);
  wheel_watch_.reset();
  unwatched_ = kUnwatched;
#endif
  perception_.forget(body());
  motion_controller_.begin({planning::ManoeuvreKind::stop, {}, {}}, body());
  cancel();
}

const Status& Robot::tick(Time now) noexcept {
  if (status_.health.fault == Fault::invalid_params) {
    status_.command = {};
    if (!drive_.command(status_.command)) count(status_.health.drive_refused);
    return status_;
  }
  check_clock(now);
  sense(now);
  localization::CountStep counts;
  const bool measured = measure(counts);
  if (motion_controller_.settled() && !was_settled_) settled_since_ = now;
  was_settled_ = motion_controller_.settled();
  navigate();
  drive(measured ? &counts : nullptr);
  return status_;
}

#ifdef WHISKER_SMALL
// No movement is judged for how long it holds, so the wheels' speeds may go by the nominal period.
void Robot::check_clock(Time now) noexcept {
  const Duration gap = now - last_tick_;
  last_tick_ = now;
  if (!started_) {
    started_ = true;
    conditioner_.reset(now);
    settled_since_ = now;
  } else if (gap <= Duration{} || gap > longest_gap(params_)) {
    count(status_.health.clock_jumps);
    fail(Fault::clock_jump);
  } else if (gap.raw() - params_.safety.period.raw() > params_.safety.period.raw() >> 2) {
    count(status_.health.late_ticks);
  }
}
#else
void Robot::check_clock(Time now) noexcept {
  if (!started_) {
    started_ = true;
    conditioner_.reset(now);
    settled_since_ = now;
    pass(params_.safety.period);
  } else {
    const Duration gap = now - last_tick_;
    const bool longer = gap > longest_gap(params_);
    const bool braked = braked_elsewhere_ && gap <= params_.safety.lost_after;
    if (longer && braked) perception_.lose_history();
    if (gap <= Duration{} || (longer && !braked)) {
      count(status_.health.clock_jumps);
      fail(Fault::clock_jump);
    } else if (gap > params_.safety.period + params_.safety.period / 4) {
      count(status_.health.late_ticks);
    }
    pass(gap > Duration{} ? gap : params_.safety.period);
  }
  last_tick_ = now;
  braked_elsewhere_ = false;
}

void Robot::pass(Duration gap) noexcept {
  elapsed_ = min(gap, longest_gap(params_));
  since_counts_ += gap;
  if (unwatched_ > Duration{}) {
    unwatched_ -= gap;
  } else {
    wheel_watch_.expect(motion_controller_.wheels().rolling, elapsed_);
  }
}
#endif

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

bool Robot::measure(localization::CountStep& step) noexcept {
  hal::EncoderCounts counts{};
  if (!drive_.read(counts)) {
    count(status_.health.encoder_refused);
    if (encoder_refusals_.refuse(params_.safety.max_refusals)) fail(Fault::drive_refused);
    return false;
  }
  encoder_refusals_.accept();
  const bool sound = odometry_.update(counts, since_counts(), step);
  since_counts_ = Duration{};
  if (!sound) {
    count(status_.health.encoder_jumps);
    fail(Fault::encoder_jump);
    return false;
  }
  const Pose inside = odometry_.pose();
  status_.pose = frame_.outward(inside);
#ifndef WHISKER_SMALL
  if (!faulted() && !(within(status_.pose.at, kBodyLimit) && within(inside.at, kBodyLimit))) leave_region();
#endif
  watch_wheels(step);
  return true;
}

void Robot::leave_region() noexcept {
  count(status_.health.pose_out_of_range);
  fail(Fault::pose_out_of_range);
}

void Robot::navigate() noexcept {
  if (faulted()) return;
  const bool settled = motion_controller_.settled();
  planning::View view;
  view.pose = body();
  view.elapsed = elapsed();
  view.settled = settled;
  if (settled) view.static_scan = conditioner_.look(settled_since_, params_);
  const WheelPair rolling = motion_controller_.wheels().rolling;
  view.forward = (rolling.left + rolling.right) / 2;
  view.turning = (rolling.right - rolling.left) / 2;
  perception::Perception::ConeObservations observations{};
  perception_.observe({view.pose, last_tick_, settled, settled_since_}, conditioner_, params_, observations,
                      view);
  status_.decision = planner_.step(view);
  has_goal_ = status_.decision.outcome == planning::Outcome::running;
  if (goal_refused_) {
    status_.decision.outcome = planning::Outcome::gave_up;
    status_.decision.mode = planning::Mode::gave_up;
    status_.decision.why = planning::Why::goal_out_of_range;
  }
#ifndef WHISKER_SMALL
  limit_turning(status_.decision.manoeuvre, params_);
#endif
  perception_.guard(status_.decision.manoeuvre, view.pose, motion_controller_.wheels(), elapsed(), params_);
  motion_controller_.begin(status_.decision.manoeuvre, view.pose);
  if (!beams_fresh_ && status_.decision.outcome == planning::Outcome::running) {
    status_.decision.why = planning::Why::blind;
  }
  watch_look(settled);
  watch_place();
}

void Robot::watch_look(bool settled) noexcept {
  const bool waits = settled && status_.decision.outcome == planning::Outcome::running &&
                     status_.decision.manoeuvre.kind == planning::ManoeuvreKind::keep;
  // Each reading that a look needs may take `lost_after` before the beam is lost, and one is under way.
  const Duration longest = params_.safety.lost_after * (params_.conditioning.reads + 1);
  if (waits && last_tick_ - settled_since_ > longest) {
    count(status_.health.unsteady_looks);
    fail(Fault::range_unsteady);
  }
}

void Robot::watch_driver() noexcept {
  if (faulted()) return;
  if (motion_controller_.stalled_for() > params_.safety.stalled_after) {
    count(status_.health.wheel_stalls);
    fail(Fault::wheels_stalled);
  } else if (motion_controller_.waiting_for() > params_.safety.stalled_after) {
    count(status_.health.no_progress);
    fail(Fault::no_progress);
  }
}

void Robot::watch_wheels(const localization::CountStep& counts) noexcept {
#ifdef WHISKER_SMALL
  static_cast<void>(counts);
#else
  if (faulted() || unwatched_ > Duration{}) return;
  switch (wheel_watch_.judge(counts)) {
    case safety::WheelWatch::Finding::none: break;
    case safety::WheelWatch::Finding::stalled:
      count(status_.health.wheel_stalls);
      fail(Fault::wheels_stalled);
      break;
    case safety::WheelWatch::Finding::runaway:
      count(status_.health.wheel_runaways);
      fail(Fault::wheel_runaway);
      break;
  }
#endif
}

/// Whatever a planner waits for or tries, it does not try it for ever in one place.
void Robot::watch_place() noexcept {
#ifndef WHISKER_SMALL
  const bool leaves = farther(body().at - place_, for_body(params_, kPlace));
  if (leaves || status_.decision.outcome != planning::Outcome::running) {
    place_ = body().at;
    at_place_for_ = Duration{};
    return;
  }
  at_place_for_ += elapsed_;
  if (at_place_for_ <= longest_stay_) return;
  count(status_.health.no_progress);
  fail(Fault::no_progress);
#endif
}

void Robot::drive(const localization::CountStep* counts) noexcept {
  const bool paused = faulted() || !beams_fresh_ || drive_refusals_.refused() || counts == nullptr;
  const WheelPair speeds = motion_controller_.step(body(), counts, paused, elapsed(), params_);
  watch_driver();
  status_.command = control::to_wire(speeds);
  if (drive_.command(status_.command)) {
    drive_refusals_.accept();
    return;
  }
  count(status_.health.drive_refused);
  motion_controller_.halt();
  status_.command = {};
  if (drive_refusals_.refuse(params_.safety.max_refusals)) fail(Fault::drive_refused);
}

void Robot::show_fault() noexcept {
  status_.decision.manoeuvre = {};
  status_.decision.mode = planning::Mode::stopped;
  status_.decision.why = planning::Why::fault;
  status_.decision.looked = false;
}

void Robot::fail(Fault fault) noexcept {
  if (faulted()) return;
  status_.health.fault = fault;
  show_fault();
}

}  // namespace whisker
