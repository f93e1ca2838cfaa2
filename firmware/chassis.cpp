#include "firmware/chassis.hpp"

namespace whisker {
namespace {

constexpr uint16_t kMostContradictions = 5 * RangeTrust::kOnePerMetre;

}  // namespace

Chassis::Chassis(hal::Rangefinders& rangefinders, hal::Drive& drive, hal::Gyro* gyro, const Params& params,
                 localization::Estimate& estimate, Health& health) noexcept
    : rangefinders_(rangefinders),
      gyro_(gyro),
      params_(params),
      localizer_(params, estimate, health),
      wheels_(drive),
      supervisor_(params, health) {}

void Chassis::configure() noexcept {
  localizer_.configure();
  perception_.configure(params_);
  warned_speed_.configure(params_);
  pace_.configure(params_);
  supervisor_.configure();
}

void Chassis::put_down(const Pose& pose) noexcept {
  localizer_.put_down(pose);
  perception_.forget(pose);
  limiter_.reset();
}

void Chassis::reset() noexcept {
  supervisor_.reset();
  started_ = false;
}

void Chassis::carry_on() noexcept {
  since_counts_ += safety::braking_time(params_);
  localizer_.restart_lessons();
  perception_.forget(pose());
  limiter_.reset();
}

bool Chassis::take_time(Time now) noexcept {
  const bool first = !started_;
  Duration gap = params_.safety.period;
  if (first) {
    started_ = true;
    perception_.start(now);
  } else {
    const Duration passed = now - last_tick_;
    const bool excused = braked_elsewhere_ && passed <= derived::lost_after(params_);
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
  return !first;
}

Chassis::Counted Chassis::take_counts() noexcept {
  using Stepped = localization::Localizer::Stepped;
  localization::Localizer::Step step;
  const bool read = wheels_.read(step.counts);
  supervisor_.check_counts(read);
  if (!read) return Counted::no;
  hal::GyroReading reading{};
  if (localizer_.has_gyro() && gyro_ != nullptr && gyro_->read(reading)) step.gyro = &reading;
  step.commanded = wheels_.sent().left != 0 || wheels_.sent().right != 0;
  step.since = since_counts_;
  since_counts_ = Duration{};
  const Stepped stepped = localizer_.step(step);
  if (stepped == Stepped::jumped) {
    supervisor_.fail(Fault::encoder_jump, supervisor_.health().encoder_jumps);
    return Counted::no;
  }
  const bool inside = within(localizer_.outside().at, kBodyLimit) && within(pose().at, kBodyLimit);
  if (!faulted() && !inside) {
    supervisor_.fail(Fault::pose_out_of_range, supervisor_.health().pose_out_of_range);
  }
  supervisor_.check_wheels(localizer_.counts());
  return stepped == Stepped::corrected ? Counted::corrected : Counted::yes;
}

void Chassis::sense(hal::RangeReadings& readings) noexcept {
  const bool read = rangefinders_.read(readings);
  perception_.sense(read ? &readings : nullptr, last_tick_, pose(), params_, supervisor_.health());
  supervisor_.check_ranges(perception_.lost_for(last_tick_));
}

void Chassis::observe(bool settled, Time settled_since, perception::Percept& out) noexcept {
  perception_.observe({pose(), last_tick_, settled, settled_since}, params_, out);
  nearest_ = perception::nearest(out.moving_scan);
  supervisor_.health().ranges = perception_.trust();
  supervisor_.check_trust(perception_.trust().level);
}

planning::VelocityRequest Chassis::slowed(planning::VelocityRequest request, Q14 step) noexcept {
  const bool slows = perception_.slows();
  const bool err = perception_.readings_err();
  if (!slows && !perception_.doubts()) {
    pace_.stand();
    return request;
  }
  const Speed floor = warned_speed_.most({}, err, slows, params_);
  const bool paced = request.forward > Speed{} && !err && !slows && trusts_ground();
  const Speed wanted = paced ? pace_.wanted(step, nearest_) : Speed{};
  const Speed pace = pace_.follow(wanted, floor, elapsed_, params_);
  if (pace <= floor) pace_.stand();
  const Speed most = warned_speed_.most(request.turning, err, slows, params_);
  request.forward = whisker::limit(request.forward, max(most, pace - abs(request.turning)));
  return request;
}

bool Chassis::trusts_ground() const noexcept {
  return !perception_.local_grid().doubting() && perception_.trust().contradictions < kMostContradictions;
}

WheelPair Chassis::limit(const planning::VelocityRequest& request) noexcept {
  return limiter_.step(request, pose(), wheels_.state(), perception_.local_grid(), elapsed_, params_);
}

WheelPair Chassis::retrace(const planning::VelocityRequest& request) noexcept {
  return limiter_.retrace(request, wheels_.state(), elapsed_, params_);
}

WheelPair Chassis::halt() noexcept {
  wheels_.halt();
  return limiter_.stop();
}

void Chassis::watch(WheelPair speeds, bool counted) noexcept {
  if (!counted) return;
  supervisor_.check_stall(localizer_.counts(), control::turns_on_wire(speeds), wheels_.state().rolling,
                          elapsed_);
}

hal::WheelSpeeds Chassis::actuate(WheelPair speeds) noexcept {
  supervisor_.check_command(wheels_.command(speeds));
  return wheels_.sent();
}

}  // namespace whisker
