#include "firmware/guard.hpp"

namespace whisker {
namespace {

constexpr Length kStandsStill = 1_mm;

/// part / whole, 0 to 1; 1 if nothing was asked.
Q14 share(Speed part, Speed whole) noexcept {
  if (whole == Speed{}) return Q14::ratio(1, 1);
  const int64_t q14 = multiply_divide(part.raw(), Q14::kOne, whole.raw());
  return Q14::from_raw(static_cast<int16_t>(q14 < 0 ? 0 : q14 > Q14::kOne ? Q14::kOne : q14));
}

Speed forward_of(WheelPair wheels) noexcept { return (wheels.left + wheels.right) / 2; }
Speed turning_of(WheelPair wheels) noexcept { return (wheels.right - wheels.left) / 2; }

}  // namespace

const char* name(GuardReason reason) noexcept {
  switch (reason) {
    case GuardReason::clear: return "clear";
    case GuardReason::fault: return "fault";
    case GuardReason::stale_ranges: return "stale_ranges";
    case GuardReason::command_timeout: return "command_timeout";
    case GuardReason::nodding: return "nodding";
    case GuardReason::obstacle: return "obstacle";
    case GuardReason::unseen: return "unseen";
    case GuardReason::doubt: return "doubt";
    case GuardReason::limits: return "limits";
    case GuardReason::assisted: return "assisted";
  }
  return "?";
}

Guard::Guard(hal::Rangefinders& rangefinders, hal::Drive& drive, const Params& params,
             hal::Gyro* gyro) noexcept
    : rangefinders_(rangefinders),
      params_(params),
      gyro_(gyro),
      localizer_(params, status_, status_.health),
      wheels_(drive),
      supervisor_(params, status_.health) {
  if (!usable()) {
    supervisor_.fail(Fault::invalid_params);
    status_.reason = GuardReason::fault;
    return;
  }
  localizer_.configure();
  perception_.configure(params);
  warned_speed_.configure(params);
  supervisor_.configure();
  fastest_on_the_spot_ = turn_rate(params) * (params.body.track / 2);
  put_down();
}

bool Guard::usable() const noexcept {
  if (params_.bumper.creep_speed != Speed{}) return false;
  return check(params_) == ParamFault::none;
}

void Guard::put_down() noexcept {
  localizer_.put_down(Pose{});
  perception_.forget(Pose{});
  limiter_.reset();
  nod_.reset();
  started_ = commanded_ = false;
  vouched_ = Length{};
}

void Guard::reset() noexcept {
  if (status_.health.fault == Fault::invalid_params) return;
  supervisor_.reset();
  put_down();
}

void Guard::command(const Velocity& velocity, Time now) noexcept {
  command_ = velocity;
  commanded_at_ = now;
  commanded_ = true;
}

void Guard::vouch(Length radius) noexcept {
  vouched_ = radius;
  vouched_at_ = localizer_.inside().at;
}

const GuardStatus& Guard::tick(Time now) noexcept {
  if (status_.health.fault == Fault::invalid_params) {
    supervisor_.check_command(wheels_.command({}));
    return status_;
  }
  take_time(now);
  const bool counted = take_counts();
  perceive();
  take_command();
  const WheelPair speeds = limit_speed(!counted);
  if (counted) {
    supervisor_.check_stall(localizer_.counts(), control::turns_on_wire(speeds), wheels_.state().rolling,
                            elapsed_);
  }
  supervisor_.check_command(wheels_.command(speeds));
  status_.command = wheels_.sent();
  if (supervisor_.faulted()) status_.reason = GuardReason::fault;
  return status_;
}

void Guard::take_time(Time now) noexcept {
  Duration gap = params_.safety.period;
  if (!started_) {
    started_ = true;
    perception_.start(now);
  } else {
    const Duration passed = now - last_tick_;
    const bool excused = braked_elsewhere_ && passed <= params_.safety.lost_after;
    if (excused && passed > longest_gap(params_)) perception_.lose_history();
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

bool Guard::take_counts() noexcept {
  localization::Localizer::Step step;
  const bool read = wheels_.read(step.counts);
  supervisor_.check_counts(read);
  if (!read) return false;
  hal::GyroReading reading{};
  if (localizer_.has_gyro() && gyro_ != nullptr && gyro_->read(reading)) step.gyro = &reading;
  step.commanded = status_.command.left != 0 || status_.command.right != 0;
  step.since = since_counts_;
  since_counts_ = Duration{};
  if (localizer_.step(step) == localization::Localizer::Stepped::jumped) {
    supervisor_.fail(Fault::encoder_jump, status_.health.encoder_jumps);
    return false;
  }
  if (!supervisor_.faulted() && !within(localizer_.inside().at, kBodyLimit)) {
    supervisor_.fail(Fault::pose_out_of_range, status_.health.pose_out_of_range);
  }
  supervisor_.check_wheels(localizer_.counts());
  return true;
}

void Guard::perceive() noexcept {
  const Pose pose = localizer_.inside();
  hal::RangeReadings readings{};
  const bool read = rangefinders_.read(readings);
  perception_.sense(read ? &readings : nullptr, last_tick_, pose, params_, status_.health);
  supervisor_.check_ranges(perception_.lost_for(last_tick_));
  if (supervisor_.faulted()) return;
  perception::Percept percept;
  perception_.observe({pose, last_tick_, false, {}}, params_, percept);
  status_.health.ranges = perception_.trust();
  supervisor_.check_trust(perception_.trust().level);
  if (vouched_ == Length{}) return;
  if (farther(pose.at - vouched_at_, kStandsStill) || perception_.vouch(vouched_, pose)) vouched_ = Length{};
}

/// The time of a command cannot be later than that of the tick that takes it.
void Guard::take_command() noexcept {
  if (commanded_ && commanded_at_ - last_tick_ > Duration{}) commanded_at_ = last_tick_;
  commanded_ = commanded_ && last_tick_ - commanded_at_ <= params_.guard.command_timeout;
  status_.asked = commanded_ ? command_ : Velocity{};
}

/// If the turn rate exceeds the limit, both speeds are scaled, so that the path keeps its curvature.
planning::VelocityRequest Guard::request() const noexcept {
  const Speed turning = status_.asked.turning * (params_.body.track / 2);
  const Speed forward = status_.asked.forward;
  const Speed fastest = params_.wheels.max_turn_rate * (params_.body.track / 2);
  const Speed most = forward == Speed{} ? fastest_on_the_spot_ : fastest;
  if (forward == Speed{} && turning == Speed{}) return {};
  if (abs(turning) <= most) return {forward, turning, true};
  return {Speed::from_raw(saturate32(multiply_divide(forward.raw(), most.raw(), abs(turning).raw()))),
          limit(turning, most), true};
}

WheelPair Guard::limit_speed(bool paused) noexcept {
  const bool fresh = perception_.lost_for(last_tick_) <= params_.conditioning.stale_after;
  const bool stands = paused || !fresh || supervisor_.faulted() || supervisor_.refused();
  const planning::VelocityRequest asked = request();
  const Pose pose = localizer_.inside();
  planning::VelocityRequest wanted = asked;
  if (assists()) {
    wanted = assist_.step(asked, fastest_on_the_spot_, pose, perception_.local_grid(), params_);
  }
  planning::VelocityRequest limited = wanted;
  if (stands) limited = {};
  const bool slows = perception_.slows();
  if (slows || perception_.doubts()) {
    const Speed most = warned_speed_.most(limited.turning, perception_.readings_err(), slows, params_);
    limited.forward = limit(limited.forward, most);
  }
  const bool doubted = limited.forward != wanted.forward;
  // Without readings, nothing is seen yet.
  const bool seeing = vouched_ == Length{} && perception::usable(perception_.latest());
  if (params_.guard.nods == Fitted::yes && seeing) {
    limited = nod_.step(limited, limiter_.granted(), pose, perception_.local_grid(), elapsed_, params_);
  }
  const WheelPair speeds =
      limiter_.step(limited, pose, wheels_.state(), perception_.local_grid(), elapsed_, params_);
  const WheelPair aim = target(limited);
  status_.forward = share(forward_of(aim), status_.asked.forward);
  const Speed turning = status_.asked.turning * (params_.body.track / 2);
  status_.turning = nodding() ? Q14{} : share(turning_of(aim), turning);
  constexpr Q14 kAll = Q14::ratio(999, 1000);
  const bool bent = assists() && assist_.active();
  const bool granted_in_full = status_.forward >= kAll && status_.turning >= kAll;
  status_.reason = !fresh                     ? GuardReason::stale_ranges
                   : !commanded_              ? GuardReason::command_timeout
                   : nodding()                ? GuardReason::nodding
                   : granted_in_full && !bent ? GuardReason::clear
                                              : held_by(asked, doubted);
  return speeds;
}

/// What the wheels are on the way to.
WheelPair Guard::target(const planning::VelocityRequest& limited) const noexcept {
  if (!limited.moves) return {};
  const Speed top = params_.wheels.max_speed;
  const WheelPair aim = inverse_kinematics(limited.forward * limiter_.granted(), limited.turning, top);
  if (limiter_.granted() != Q14{}) return aim;
  // Nothing of the forward speed: it turns, unless it only brakes.
  return limiter_.brakes() ? WheelPair{} : aim;
}

GuardReason Guard::held_by(const planning::VelocityRequest& asked, bool doubted) const noexcept {
  if (limiter_.granted() == Q14::ratio(1, 1)) {
    if (doubted) return GuardReason::doubt;
    return assists() && assist_.active() ? GuardReason::assisted : GuardReason::limits;
  }
  const perception::LocalGrid& grid = perception_.local_grid();
  const Pose pose = localizer_.inside();
  const Angle way = pose.heading + (asked.forward < Speed{} ? 180_deg : Angle{});
  const perception::Obstacles found = grid.along(pose.at, way, params_.body.radius, grid.reach().guard, 1);
  return found.suspect > 0 ? GuardReason::obstacle : GuardReason::unseen;
}

}  // namespace whisker
