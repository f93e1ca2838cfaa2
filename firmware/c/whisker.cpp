#include "firmware/c/whisker.h"

#include <stddef.h>

#include "firmware/guard.hpp"
#include "firmware/params/words.hpp"
#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planners.hpp"
#include "firmware/robot.hpp"

namespace whisker::c {

struct Room {
  void* at;
};

}  // namespace whisker::c

// Some freestanding compilers have no <new>.
inline void* operator new(size_t, whisker::c::Room room) noexcept { return room.at; }

namespace whisker::c {
namespace {

static_assert(sizeof(Params) <= sizeof(whisker_params) && kParams <= WHISKER_PARAM_ROOM);
static_assert(alignof(Params) <= alignof(whisker_params));
static_assert(static_cast<int>(hal::RangeStatus::stale) == WHISKER_RANGE_STALE);
static_assert(static_cast<int>(planning::Outcome::gave_up) == WHISKER_OUTCOME_GAVE_UP);
static_assert(static_cast<int>(GuardReason::assisted) == WHISKER_GUARD_ASSISTED);

/// The functions that each board must have.
bool has_drivers(const whisker_board& board) noexcept {
  return board.ranges != nullptr && board.counts != nullptr && board.speeds != nullptr;
}

/// The functions of a board as the interfaces of hal/.
class Drivers final : public hal::Rangefinders, public hal::Drive, public hal::Bumper, public hal::Gyro {
 public:
  explicit Drivers(const whisker_board& board) noexcept : board_(board) {}

  bool read(hal::RangeReadings& out) noexcept override {
    whisker_range readings[hal::kBeams];
    for (whisker_range& r : readings) r = {0, WHISKER_RANGE_INVALID, 255, 0};
    if (!board_.ranges(board_.user, readings)) return false;
    for (int beam = 0; beam < hal::kBeams; ++beam) {
      const whisker_range& r = readings[beam];
      out.beam[beam] = {r.mm, static_cast<hal::RangeStatus>(r.status), r.age_ms, r.sequence};
    }
    return true;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    hal::EncoderCounts counts = out;
    if (!board_.counts(board_.user, &counts.left, &counts.right)) return false;
    out = counts;
    return true;
  }
  bool read(hal::BumperReading& out) noexcept override {
    uint8_t pressed = 0;
    if (!board_.bumper(board_.user, &pressed)) return false;
    out.pressed = pressed;
    return true;
  }
  bool read(hal::GyroReading& out) noexcept override {
    whisker_gyro reading{};
    if (!board_.gyro(board_.user, &reading)) return false;
    out = {reading.sum, reading.samples, reading.saturated};
    return true;
  }
  bool command(hal::WheelSpeeds speeds) noexcept override {
    return board_.speeds(board_.user, speeds.left, speeds.right);
  }

 private:
  const whisker_board board_;
};

Params params_from(const whisker_params& from) noexcept {
  Params params;
  for (int i = 0; i < kParams; ++i) set_raw_param(params, i, from.words[i]);
  return params;
}

struct RobotForC {
  RobotForC(const whisker_params& set, const whisker_board& board) noexcept
      : params(params_from(set)),
        drivers(board),
        planner(params, fuzzy::kDefaultTable),
        robot(drivers, drivers, planning::planner_in(planner), params, board.bumper ? &drivers : nullptr,
              board.gyro ? &drivers : nullptr) {}
  const Params params;
  Drivers drivers;
  planning::DefaultPlanner planner;
  Robot robot;
};
static_assert(sizeof(RobotForC) <= sizeof(whisker_robot), "set WHISKER_ROBOT_BYTES");
static_assert(alignof(RobotForC) <= alignof(whisker_robot));

Robot& robot_in(whisker_robot* room) noexcept { return reinterpret_cast<RobotForC*>(room)->robot; }
constexpr Pose pose_of(int32_t x_um, int32_t y_um, uint32_t heading) noexcept {
  return {{micrometres(x_um), micrometres(y_um)}, Angle::from_raw(heading)};
}

struct GuardForC {
  GuardForC(const whisker_params& set, const whisker_board& board) noexcept
      : params(params_from(set)),
        drivers(board),
        guard(drivers, drivers, params, board.gyro ? &drivers : nullptr) {}
  const Params params;
  Drivers drivers;
  Guard guard;
};
static_assert(sizeof(GuardForC) <= sizeof(whisker_guard), "set WHISKER_GUARD_BYTES");
static_assert(alignof(GuardForC) <= alignof(whisker_guard));

Guard& guard_in(whisker_guard* room) noexcept { return reinterpret_cast<GuardForC*>(room)->guard; }

/// The pose and how far it may be off: the same fields of both kinds of status.
template <class Out>
Out estimate_of(const localization::Estimate& s) noexcept {
  Out out{};
  out.x_um = s.pose.at.x.raw();
  out.y_um = s.pose.at.y.raw();
  out.heading = s.pose.heading.raw();
  if (s.sigma_known) {
    out.sigma_along_um = static_cast<uint32_t>(s.sigma.along.raw());
    out.sigma_across_um = static_cast<uint32_t>(s.sigma.across.raw());
    out.sigma_heading = s.sigma.heading.raw();
  }
  return out;
}

whisker_guard_status status_of(const GuardStatus& s) noexcept {
  auto out = estimate_of<whisker_guard_status>(s);
  out.asked_forward = s.asked.forward.raw();
  out.asked_turning = s.asked.turning.raw();
  out.granted_forward = static_cast<uint16_t>(s.forward.raw());
  out.granted_turning = static_cast<uint16_t>(s.turning.raw());
  out.left = s.command.left;
  out.right = s.command.right;
  out.reason = static_cast<uint8_t>(s.reason);
  out.fault = static_cast<uint8_t>(s.health.fault);
  return out;
}

whisker_status status_of(const Status& s) noexcept {
  auto out = estimate_of<whisker_status>(s);
  out.left = s.command.left;
  out.right = s.command.right;
  out.outcome = static_cast<uint8_t>(s.decision.outcome);
  out.mode = static_cast<uint8_t>(s.decision.mode);
  out.why = static_cast<uint8_t>(s.decision.why);
  out.fault = static_cast<uint8_t>(s.health.fault);
  out.pressed = s.pressed;
  return out;
}

}  // namespace
}  // namespace whisker::c

using namespace whisker;

void whisker_default_params(whisker_params* params) {
  const Params defaults;
  *params = {};
  for (int i = 0; i < kParams; ++i) params->words[i] = raw_param(defaults, i);
}

bool whisker_set_param(whisker_params* params, enum whisker_param which, uint32_t value) {
  const int number = static_cast<int>(which);
  if (number < 0 || number >= kParams || !in_own_range(number, value)) return false;
  params->words[number] = value;
  return true;
}

uint32_t whisker_get_param(const whisker_params* params, enum whisker_param which) {
  const int number = static_cast<int>(which);
  return number < 0 || number >= kParams ? 0 : params->words[number];
}

uint8_t whisker_check_params(const whisker_params* params) {
  return static_cast<uint8_t>(check(c::params_from(*params)));
}

const char* whisker_param_fault_name(uint8_t fault) { return name(static_cast<ParamFault>(fault)); }

uint32_t whisker_heading(int32_t millidegrees) { return Angle::turns(millidegrees, 360000).raw(); }

bool whisker_create(whisker_robot* robot, const whisker_params* params, const whisker_board* board) {
  if (!c::has_drivers(*board)) return false;
  new (c::Room{robot}) c::RobotForC(*params, *board);
  return true;
}

bool whisker_place(whisker_robot* robot, int32_t x_um, int32_t y_um, uint32_t heading) {
  return c::robot_in(robot).place(c::pose_of(x_um, y_um, heading));
}

bool whisker_correct(whisker_robot* robot, int32_t x_um, int32_t y_um, uint32_t heading, int32_t sigma_um,
                     uint32_t sigma_heading) {
  const Length sigma = micrometres(sigma_um);
  return c::robot_in(robot).correct(c::pose_of(x_um, y_um, heading),
                                    {sigma, sigma, Angle::from_raw(sigma_heading)});
}

bool whisker_set_goal(whisker_robot* robot, int32_t x_um, int32_t y_um, int32_t tolerance_um) {
  return c::robot_in(robot).set_goal({{micrometres(x_um), micrometres(y_um)}, micrometres(tolerance_um)});
}

void whisker_cancel(whisker_robot* robot) { c::robot_in(robot).cancel(); }

void whisker_reset(whisker_robot* robot) { c::robot_in(robot).reset(); }

void whisker_tick(whisker_robot* robot, uint32_t now_ms, whisker_status* status) {
  const Status& result = c::robot_in(robot).tick(Time::from_raw(now_ms));
  if (status != nullptr) *status = c::status_of(result);
}

void whisker_get_status(const whisker_robot* robot, whisker_status* status) {
  *status = c::status_of(reinterpret_cast<const c::RobotForC*>(robot)->robot.status());
}

bool whisker_guard_create(whisker_guard* guard, const whisker_params* params, const whisker_board* board) {
  if (!c::has_drivers(*board)) return false;
  new (c::Room{guard}) c::GuardForC(*params, *board);
  return true;
}

void whisker_guard_command(whisker_guard* guard, int32_t forward, int32_t turning, uint32_t now_ms) {
  c::guard_in(guard).command({Speed::from_raw(forward), AngularRate::from_raw(turning)},
                             Time::from_raw(now_ms));
}

void whisker_guard_vouch(whisker_guard* guard, int32_t radius_um) {
  c::guard_in(guard).vouch(micrometres(radius_um > 0 ? radius_um : 0));
}

void whisker_guard_reset(whisker_guard* guard) { c::guard_in(guard).reset(); }

void whisker_guard_tick(whisker_guard* guard, uint32_t now_ms, whisker_guard_status* status) {
  const GuardStatus& result = c::guard_in(guard).tick(Time::from_raw(now_ms));
  if (status != nullptr) *status = c::status_of(result);
}

void whisker_guard_get_status(const whisker_guard* guard, whisker_guard_status* status) {
  *status = c::status_of(reinterpret_cast<const c::GuardForC*>(guard)->guard.status());
}

const char* whisker_guard_reason_name(uint8_t reason) { return name(static_cast<GuardReason>(reason)); }

const char* whisker_fault_name(uint8_t fault) { return name(static_cast<Fault>(fault)); }
const char* whisker_mode_name(uint8_t mode) { return planning::name(static_cast<planning::Mode>(mode)); }
const char* whisker_why_name(uint8_t why) { return planning::name(static_cast<planning::Why>(why)); }
