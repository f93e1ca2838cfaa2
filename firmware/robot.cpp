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
    : planner_(planner),
      params_(params),
      bumper_(bumper),
      chassis_(rangefinders, drive, gyro, params, status_, status_.health) {
  if (check(params) != ParamFault::none) {
    chassis_.supervisor().fail(Fault::invalid_params);
    show_fault();
    return;
  }
  chassis_.configure();
  motion_.configure(params);
}

bool Robot::placeable(const Pose& pose) noexcept {
  if (unfit()) return false;
  if (within(pose.at, kPlaceLimit)) return true;
  chassis_.supervisor().fail(Fault::pose_out_of_range, status_.health.pose_out_of_range);
  show_fault();
  return false;
}

bool Robot::place(const Pose& pose) noexcept {
  if (!placeable(pose)) return false;
  if (chassis_.started() && !chassis_.faulted() && has_goal_) {
    chassis_.localizer().move(pose);
  } else {
    chassis_.put_down(pose);
    if (kGyroBuilt) walls_->restart();
    reflex_.reset();
  }
  if (has_goal_) aim_again();
  return true;
}

bool Robot::correct(const Pose& pose, const localization::PoseSigma& sigma) noexcept {
  if (!placeable(pose) || !chassis_.localizer().correct(pose, sigma)) return false;
  if (has_goal_) aim_again();
  return true;
}

void Robot::aim_again() noexcept {
  Vec at;
  if (aimed(out_of_range(!chassis_.localizer().frame().aim_again(at)))) planner_.move_goal(at);
}

bool Robot::aimed(planning::Why refused) noexcept {
  refused_ = refused;
  has_goal_ = refused == planning::Why::none;
  if (!has_goal_) planner_.cancel();
  return has_goal_;
}

bool Robot::set_goal(const planning::Goal& goal) noexcept {
  if (unfit()) return false;
  planning::Goal inside = goal;
  planning::Why refused = out_of_range(!chassis_.localizer().frame().aim(goal.at, inside.at));
  if (refused == planning::Why::none && goal.tolerance < planning::smallest_tolerance(params_)) {
    refused = planning::Why::tolerance_too_small;
  }
  if (aimed(refused)) planner_.set_goal(inside);
  return has_goal_;
}

void Robot::cancel() noexcept {
  has_goal_ = false;
  refused_ = planning::Why::none;
  planner_.cancel();
}

void Robot::reset() noexcept {
  if (unfit()) return;
  chassis_.reset();
  chassis_.carry_on();
  was_settled_ = false;
  resting_for_ = Duration{};
  reflex_.reset();
  motion_.begin(planning::stop(), chassis_.pose());
  cancel();
}

const Status& Robot::tick(Time now) noexcept {
  if (unfit()) {
    actuate({});
    return status_;
  }
  planning::View view;
  const bool counted = localize(now, view);
  perceive(view, counted);
  plan(view);
  actuate(guard(view.pose, counted));
  ponder(view);
  status_.work = chassis_.work();
  if (status_.work > status_.most_work) status_.most_work = status_.work;
  return status_;
}

bool Robot::localize(Time now, planning::View& view) noexcept {
  if (!chassis_.take_time(now)) settled_since_ = waits_since_ = now;
  const Chassis::Counted counted = chassis_.take_counts();
  if (counted == Chassis::Counted::corrected && has_goal_) aim_again();
  if (motion_.settled() && !was_settled_) settled_since_ = waits_since_ = now;
  was_settled_ = motion_.settled();
  const WheelPair rolling = chassis_.wheels().rolling;
  view.pose = chassis_.pose();
  view.travelled_um = chassis_.localizer().travelled_um();
  if (kGyroBuilt && status_.sigma_known) view.bound = localization::distance_bound(status_.sigma);
  view.elapsed = chassis_.elapsed();
  view.settled = was_settled_;
  view.cut = motion_.cut();
  view.forward = (rolling.left + rolling.right) / 2;
  view.turning = (rolling.right - rolling.left) / 2;
  view.granted = chassis_.limiter().granted();
  if (counted != Chassis::Counted::no) view.raw.counts = chassis_.localizer().counts();
  view.raw.by_gyro = status_.heading_source == localization::HeadingSource::gyro;
  return counted != Chassis::Counted::no;
}

void Robot::perceive(planning::View& view, bool counted) noexcept {
  chassis_.sense(view.raw.ranges);
  status_.echoes = chassis_.perception().latest();
  if (params_.bumper.fitted == Fitted::yes) take_bumps(view.pose, counted);
  if (chassis_.faulted()) return;
  chassis_.observe(view.settled, settled_since_, view);
  if (kGyroBuilt && params_.walls.straight == Fitted::yes) {
    follow_wall(hal::kLeft, view);
    follow_wall(hal::kRight, view);
  }
  chassis_.perception().put_off(view);
}

void Robot::follow_wall(hal::Beam side, const perception::Percept& percept) noexcept {
  if ((percept.observed >> side & 1U) == 0) return;
  const perception::Beam& beam = percept.observations[side].beam;
  const perception::Echo& echo = status_.echoes.beam[side];
  const Angle edge = beam.axis + (side == hal::kLeft ? beam.half_cone : -beam.half_cone);
  const localization::WallDirection::Echo at{beam.apex + polar(edge, echo.distance),
                                             beam.axis - beam_axis(params_.rangefinders, side)};
  const bool shows = echo.validity == perception::Validity::ok;
  const Angle outward = status_.pose.heading - chassis_.pose().heading;
  localization::WallDirection::Found found;
  if (!walls_->pass(side, shows ? &at : nullptr, params_.walls.direction - outward, found)) return;
  if (chassis_.localizer().correct_heading(found.ahead, found.sigma) && has_goal_) aim_again();
}

void Robot::take_bumps(const Pose& pose, bool counted) noexcept {
  safety::Supervisor& supervisor = chassis_.supervisor();
  hal::BumperReading reading{};
  const bool read = bumper_ != nullptr && bumper_->read(reading);
  supervisor.check_bumper(read);
  if (read) status_.pressed = reading.pressed & hal::kAllSwitches;
  if (supervisor.faulted()) return;
  const localization::CountStep& counts = chassis_.localizer().counts();
  const bool still = counted && counts.left == 0 && counts.right == 0;
  const bool was_active = reflex_.active();
  const uint8_t fresh = reflex_.step(pose, {status_.pressed, has_goal_, still, chassis_.elapsed()}, params_);
  if (reflex_.active() && !was_active) motion_.interrupt();
  if (fresh != 0) {
    chassis_.perception().touch(fresh, pose);
    supervisor.check_bump(pose.at);
  }
  if (reflex_.stuck(params_)) supervisor.fail(Fault::bumper_stuck, status_.health.bumper_stuck);
}

void Robot::plan(const planning::View& view) noexcept {
  if (chassis_.faulted()) return;
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
  } else {
    ask_planner(view);
  }
  if (!chassis_.sees() && decision.outcome == planning::Outcome::running) decision.why = planning::Why::blind;
}

void Robot::ask_planner(const planning::View& view) noexcept {
  planning::Decision& decision = status_.decision;
  decision = planner_.step(view);
  if (decision.lane.opens) chassis_.perception().open_lane(decision.lane.from);
  const bool running = decision.outcome == planning::Outcome::running;
  has_goal_ = running;
  if (chassis_.supervisor().overstays(view.pose.at, running, view.elapsed)) aimed(planning::Why::no_exit);
  if (refused_ != planning::Why::none) {
    decision.outcome = planning::Outcome::gave_up;
    decision.mode = planning::Mode::gave_up;
    decision.why = refused_;
  }
  motion_.begin(decision.manoeuvre, view.pose);
  const bool waits = view.settled && running && decision.manoeuvre.kind == planning::ManoeuvreKind::keep;
  // It waits for its search, not for the readings.
  if (view.local_grid->work().is_cut_short()) waits_since_ = chassis_.now();
  chassis_.supervisor().check_look(waits, chassis_.now() - waits_since_);
}

/// The planner is not asked meanwhile.
bool Robot::rests_for_gyro() noexcept {
  localization::Localizer& localizer = chassis_.localizer();
  if (!localizer.has_gyro()) return false;
  localization::GyroBias& bias = localizer.gyro_bias();
  const bool resting = resting_for_ > Duration{};
  const bool begins = bias.stands() || bias.due_for() > kRestDelay;
  if (has_goal_ && localizer.wants_rest() && (resting || begins)) {
    if (!resting) motion_.interrupt();
    resting_for_ += chassis_.elapsed();
    if (resting_for_ < kLongestRest) return true;
    bias.postpone();
  }
  // The look at the surroundings starts again: a planner that waits for it has only waited since now.
  if (resting) settled_since_ = waits_since_ = chassis_.now();
  resting_for_ = Duration{};
  return false;
}

WheelPair Robot::guard(const Pose& pose, bool counted) noexcept {
  status_.pace = Speed{};
  const bool may_drive = chassis_.may_drive(counted) && resting_for_ == Duration{};
  const WheelPair speeds = granted(pose, may_drive);
  const bool commanded = speeds.left != Speed{} || speeds.right != Speed{};
  const localization::CountStep& counts = chassis_.localizer().counts();
  motion_.settle(counted ? &counts : nullptr, commanded, chassis_.elapsed(), params_);
  chassis_.watch(speeds, counted);
  chassis_.supervisor().check_motion(motion_);
  return speeds;
}

WheelPair Robot::granted(const Pose& pose, bool may_drive) noexcept {
  if (reflex_.stops()) return chassis_.halt();
  planning::VelocityRequest request{};
  if (may_drive && reflex_.backs()) {
    request = reflex_.request(pose, params_);
    if (reflex_.retraces()) return chassis_.retrace(request);
  } else if (may_drive) {
    request = motion_.request(pose, chassis_.elapsed(), chassis_.limiter().held_for(), params_);
  }
  request = chassis_.slowed(request, status_.decision.response.step);
  status_.pace = chassis_.pace();
  return chassis_.limit(request);
}

void Robot::actuate(WheelPair speeds) noexcept {
  status_.command = chassis_.actuate(speeds);
  if (chassis_.faulted()) show_fault();
}

void Robot::ponder(const planning::View& view) noexcept {
  if (!has_goal_ || chassis_.faulted() || view.local_grid == nullptr) return;
  view.local_grid->work().begin_rest();
  planner_.ponder(view);
}

void Robot::show_fault() noexcept {
  status_.decision.manoeuvre = {};
  status_.decision.mode = planning::Mode::stopped;
  status_.decision.why = planning::Why::fault;
  status_.decision.looked = false;
}

}  // namespace whisker
