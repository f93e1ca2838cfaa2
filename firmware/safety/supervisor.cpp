#include "firmware/safety/supervisor.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

// Motion that remains from before a reset matches no command.
constexpr Duration kUnwatched = 500_ms;
constexpr Length kPlace = 30_mm;  // for the reference body
// Limits within one place: kWaits times stalled_after(), kTurns full turns, kSteps crossings.
constexpr int32_t kWaits = 60;
constexpr int32_t kTurns = 30;
constexpr int32_t kSteps = 30;
constexpr Length kBumpedPlace = 500_mm;  // for the reference body
constexpr int8_t kMostBumps = 30;        // within it

Duration ms_at(Length way, int32_t times, Speed speed) noexcept {
  return milliseconds(multiply_divide(way.raw(), 1000 * times, speed.raw()));
}

/// Upper bound of the time for permitted activity in one place.
Duration longest_stay(const Params& p) noexcept {
  constexpr int32_t kMicroradians = 6283185;  // a turn
  const AngularRate rate = min(turn_rate(p), planning::kFastestTurn);
  const Duration turn = max(milliseconds(multiply_divide(kMicroradians, 1000, rate.raw())),
                            ms_at(p.body.track * 22 / 7, 1, p.wheels.max_speed));
  return derived::stalled_after(p) * kWaits + turn * kTurns +
         ms_at(for_body(p, kPlace), kSteps, p.wheels.max_speed);
}

}  // namespace

Duration braking_time(const Params& p) noexcept {
  return milliseconds(multiply_divide(p.wheels.max_speed.raw(), 1000, p.wheels.max_acceleration.raw())) +
         p.wheels.motor_lag * 4;
}

void Supervisor::configure() noexcept {
  wheel_watch_.configure(params_);
  longest_stay_ = longest_stay(params_);
  // A manoeuvre may begin in full motion the other way.
  longest_wait_ = derived::stalled_after(params_) + braking_time(params_) * 2;
}

void Supervisor::reset() noexcept {
  health_.fault = Fault::none;
  drive_refusals_.reset();
  encoder_refusals_.reset();
  bumper_refusals_.reset();
  bumps_ = 0;
  stall_watch_.reset();
  wheel_watch_.reset();
  unwatched_ms_ = narrow<int16_t>(kUnwatched.raw());
}

void Supervisor::fail(Fault fault) noexcept {
  if (!faulted()) health_.fault = fault;
}

void Supervisor::fail(Fault fault, uint32_t& counter) noexcept {
  count(counter);
  fail(fault);
}

void Supervisor::check_gap(Duration gap, bool excused) noexcept {
  if (gap <= Duration{} || (gap > longest_gap(params_) && !excused)) {
    fail(Fault::clock_jump, health_.clock_jumps);
  } else if (gap > params_.safety.period + params_.safety.period / 4) {
    count(health_.late_ticks);
  }
}

void Supervisor::check_counts(bool read) noexcept {
  if (read) {
    encoder_refusals_.accept();
    return;
  }
  count(health_.encoder_refused);
  if (encoder_refusals_.refuse(derived::kMostRefusals)) fail(Fault::drive_refused);
}

void Supervisor::expect_wheels(WheelPair speeds, Duration elapsed, Duration gap) noexcept {
  if (unwatched_ms_ > 0) {
    unwatched_ms_ = narrow<int16_t>(gap.raw() < unwatched_ms_ ? unwatched_ms_ - gap.raw() : 0);
  } else {
    wheel_watch_.expect(speeds, elapsed);
  }
}

void Supervisor::check_wheels(const localization::CountStep& step) noexcept {
  if (faulted() || unwatched_ms_ > 0) return;
  switch (wheel_watch_.judge(step)) {
    case WheelWatch::Finding::none: break;
    case WheelWatch::Finding::stalled: fail(Fault::wheels_stalled, health_.wheel_stalls); break;
    case WheelWatch::Finding::runaway: fail(Fault::wheel_runaway, health_.wheel_runaways); break;
  }
}

void Supervisor::check_ranges(Duration lost) noexcept {
  if (lost > derived::lost_after(params_)) fail(Fault::range_lost);
}

void Supervisor::check_trust(RangeLevel level) noexcept {
  if (level == RangeLevel::untrusted) fail(Fault::range_untrusted);
}

void Supervisor::check_look(bool waits, Duration stood) noexcept {
  // Each reading of a static scan may take `lost_after` before the beam is lost; one more is under way.
  const Duration longest = derived::lost_after(params_) * (derived::kConsensusReads + 1);
  if (waits && stood > longest) fail(Fault::range_unsteady, health_.unsteady_looks);
}

bool Supervisor::overstays(Vec at, bool running, Duration elapsed) noexcept {
  if (!running) bumps_ = 0;
  if (!running || farther(at - place_, for_body(params_, kPlace))) {
    place_ = at;
    at_place_for_ = Duration{};
    return false;
  }
  at_place_for_ += elapsed;
  return at_place_for_ > longest_stay_;
}

void Supervisor::check_bumper(bool read) noexcept {
  if (read) {
    bumper_refusals_.accept();
    return;
  }
  count(health_.bumper_refused);
  if (bumper_refusals_.refuse(derived::kMostRefusals)) fail(Fault::bumper_lost);
}

void Supervisor::check_bump(Vec at) noexcept {
  count(health_.bumps);
  if (bumps_ == 0 || farther(at - bumped_at_, for_body(params_, kBumpedPlace))) {
    bumped_at_ = at;
    bumps_ = 0;
  }
  if (bumps_ <= kMostBumps) ++bumps_;
  if (bumps_ > kMostBumps) fail(Fault::no_progress, health_.no_progress);
}

void Supervisor::check_stall(const localization::CountStep& counts, bool commanded, WheelPair rolling,
                             Duration elapsed) noexcept {
  if (!stall_watch_.stalled(counts, commanded, rolling, elapsed, params_) || faulted()) return;
  fail(Fault::wheels_stalled, health_.wheel_stalls);
}

void Supervisor::check_motion(const planning::MotionController& motion) noexcept {
  if (faulted()) return;
  if (motion.waiting_for() > longest_wait_) fail(Fault::no_progress, health_.no_progress);
}

void Supervisor::check_command(bool taken) noexcept {
  if (taken) {
    drive_refusals_.accept();
    return;
  }
  count(health_.drive_refused);
  if (drive_refusals_.refuse(derived::kMostRefusals)) fail(Fault::drive_refused);
}

}  // namespace whisker::safety
