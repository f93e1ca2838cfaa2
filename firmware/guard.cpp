#include "firmware/guard.hpp"

namespace whisker {
namespace {

constexpr Length kStandsStill = 1_mm;

/// part / whole, 0 to 1; 1 if nothing was asked.
Q14 share(Speed part, Speed whole) noexcept {
  if (whole == Speed{}) return Q14::ratio(1, 1);
  const Speed along = whole < Speed{} ? -part : part;
  const int32_t q14 = multiply_divide(along.raw(), Q14::kOne, abs(whole).raw());
  return Q14::from_raw(narrow<int16_t>(q14 < 0 ? 0 : q14 > Q14::kOne ? Q14::kOne : q14));
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
    : params_(params), chassis_(rangefinders, drive, gyro, params, status_, status_.health) {
  if (!usable()) {
    chassis_.supervisor().fail(Fault::invalid_params);
    status_.reason = GuardReason::fault;
    return;
  }
  chassis_.configure();
  fastest_on_the_spot_ = turn_rate(params) * (params.body.track / 2);
  put_down();
}

bool Guard::usable() const noexcept {
  if (params_.bumper.creep_speed != Speed{}) return false;
  return check(params_) == ParamFault::none;
}

void Guard::put_down() noexcept {
  chassis_.put_down(Pose{});
  nod_.reset();
  commanded_ = false;
  vouched_ = Length{};
}

void Guard::reset() noexcept {
  if (status_.health.fault == Fault::invalid_params) return;
  chassis_.reset();
  put_down();
}

void Guard::command(const Velocity& velocity, Time now) noexcept {
  command_ = velocity;
  commanded_at_ = now;
  commanded_ = true;
}

void Guard::vouch(Length radius) noexcept {
  vouched_ = radius;
  vouched_at_ = chassis_.pose().at;
}

const GuardStatus& Guard::tick(Time now) noexcept {
  if (status_.health.fault == Fault::invalid_params) {
    chassis_.actuate({});
    return status_;
  }
  chassis_.take_time(now);
  const bool counted = chassis_.take_counts() != Chassis::Counted::no;
  perceive();
  take_command();
  const WheelPair speeds = limit_speed(counted);
  chassis_.watch(speeds, counted);
  status_.command = chassis_.actuate(speeds);
  if (chassis_.faulted()) status_.reason = GuardReason::fault;
  return status_;
}

void Guard::perceive() noexcept {
  hal::RangeReadings readings{};
  chassis_.sense(readings);
  if (chassis_.faulted()) return;
  perception::Percept percept;
  chassis_.observe(false, {}, percept);
  if (vouched_ == Length{}) return;
  const Pose pose = chassis_.pose();
  if (farther(pose.at - vouched_at_, kStandsStill) || chassis_.perception().vouch(vouched_, pose)) {
    vouched_ = Length{};
  }
}

/// The time of a command cannot be later than that of the tick that takes it.
void Guard::take_command() noexcept {
  const Time now = chassis_.now();
  if (commanded_ && commanded_at_ - now > Duration{}) commanded_at_ = now;
  commanded_ = commanded_ && now - commanded_at_ <= params_.guard.command_timeout;
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

WheelPair Guard::limit_speed(bool counted) noexcept {
  const Pose pose = chassis_.pose();
  const perception::LocalGrid& grid = local_grid();
  const planning::VelocityRequest asked = request();
  planning::VelocityRequest wanted = asked;
  if (assists()) wanted = assist_.step(asked, fastest_on_the_spot_, pose, grid, params_);
  planning::VelocityRequest limited = wanted;
  if (!chassis_.may_drive(counted)) limited = {};
  limited = chassis_.slowed(limited, assists() ? assist_.response().step : Q14{});
  const bool doubted = limited.forward != wanted.forward;
  // Without readings, nothing is seen yet.
  const bool seeing = vouched_ == Length{} && perception::usable(chassis_.perception().latest());
  if (params_.guard.nods == Fitted::yes && seeing) {
    limited = nod_.step(limited, chassis_.limiter().granted(), pose, grid, chassis_.elapsed(), params_);
  }
  const WheelPair speeds = chassis_.limit(limited);
  const WheelPair aim = target(limited);
  status_.forward = share(forward_of(aim), status_.asked.forward);
  const Speed turning = status_.asked.turning * (params_.body.track / 2);
  status_.turning = nodding() ? Q14{} : share(turning_of(aim), turning);
  constexpr Q14 kAll = Q14::ratio(999, 1000);
  const bool bent = assists() && assist_.active();
  const bool granted_in_full = status_.forward >= kAll && status_.turning >= kAll;
  status_.reason = !chassis_.sees()           ? GuardReason::stale_ranges
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
  const WheelPair aim =
      inverse_kinematics(limited.forward * chassis_.limiter().granted(), limited.turning, top);
  if (chassis_.limiter().granted() != Q14{}) return aim;
  // Nothing of the forward speed: it turns, unless it only brakes.
  return chassis_.limiter().brakes() ? WheelPair{} : aim;
}

GuardReason Guard::held_by(const planning::VelocityRequest& asked, bool doubted) const noexcept {
  if (chassis_.limiter().granted() == Q14::ratio(1, 1)) {
    if (doubted) return GuardReason::doubt;
    return assists() && assist_.active() ? GuardReason::assisted : GuardReason::limits;
  }
  const perception::LocalGrid& grid = local_grid();
  const Pose pose = chassis_.pose();
  const Angle way = pose.heading + (asked.forward < Speed{} ? 180_deg : Angle{});
  const int32_t suspects = grid.suspects_along(pose.at, way, params_.body.radius, grid.reach().guard, 1);
  return suspects > 0 ? GuardReason::obstacle : GuardReason::unseen;
}

}  // namespace whisker
