#include "firmware/apps/calibration/self_calibration.hpp"

namespace whisker {
namespace {

bool stands(const Status& status) noexcept { return status.command.left == 0 && status.command.right == 0; }

}  // namespace

const Status& SelfCalibration::tick(Time now) noexcept {
  const hal::Press press = button_.take();
  if (press != hal::Press::none) on_press(press, now);
  if (phase_ == Phase::starts && now - pressed_at_ >= kHandsOff && stands(status())) begin();
  const Status& status = active().tick(now);
  if (phase_ == Phase::measures) watch(status);
  return status;
}

void SelfCalibration::on_press(hal::Press press, Time now) noexcept {
  active().cancel();
  calibrator_.abandon();
  if (phase_ == Phase::starts || phase_ == Phase::measures) {
    planning::follow(kArrows, phase_, Phase::cancelled);
    return;
  }
  planning::follow(kArrows, phase_, Phase::starts);
  wanted_ = press;
  pressed_at_ = now;
}

void SelfCalibration::begin() noexcept {
  params_ = bare_;
  calibrator_.apply(params_);
  planning::Planner& planner =
      wanted_ == hal::Press::held ? calibrator_.spin(params_) : calibrator_.straight(params_, kStraight);
  own_ = &room_.make<Robot>(devices_.rangefinders, devices_.drive, planner, params_, devices_.bumper,
                            devices_.gyro);
  own_->place({});
  own_->set_goal({{kStraight, Length{}}, 100_mm});
  planning::follow(kArrows, phase_, Phase::measures);
}

void SelfCalibration::watch(const Status& status) noexcept {
  if (status.health.fault != Fault::none) {
    calibrator_.abandon();
    planning::follow(kArrows, phase_, Phase::cancelled);
  } else if (status.decision.outcome != planning::Outcome::running && stands(status)) {
    calibrator_.finish();
    // No ticks came meanwhile.
    own_->reset();
    planning::follow(kArrows, phase_, Phase::ended);
  }
}

const char* SelfCalibration::word() const noexcept {
  switch (phase_) {
    case Phase::none: return nullptr;
    case Phase::starts: return "starts";
    case Phase::measures: return "measures";
    case Phase::cancelled: return "cancelled";
    case Phase::ended:
      return calibrator_.trouble() != planning::Trouble::none ? planning::name(calibrator_.trouble())
                                                              : storage::name(calibrator_.stored());
  }
  return nullptr;
}

}  // namespace whisker
