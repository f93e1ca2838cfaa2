#include "firmware/apps/can/whole_robot.hpp"

#include "firmware/can/braking.hpp"
#include "firmware/math/fixed.hpp"
#include "firmware/version.hpp"

namespace whisker::can_app {
namespace {

constexpr uint8_t kRobot = 1;
constexpr Length kTolerance = 100_mm;

/// What a wheel loses in a period while the base brakes, 0.1 mm/s.
int16_t ramp_of(const Params& p) noexcept {
  const int32_t um_per_s = (p.wheels.max_acceleration * p.safety.period).raw();
  return saturate16(um_per_s / 100 > 0 ? um_per_s / 100 : 1);
}

Params kept_or(const Params& defaults, can::ParamStore& store) noexcept {
  Params params = defaults;
  store.load(params);
  return params;
}

}  // namespace

WholeRobot::WholeRobot(hal::CanPort& line, uint16_t boot, const Params& defaults, const Devices& devices,
                       const Stores& stores) noexcept
    : bus_(line),
      store_(stores.params, kVersionNumber),
      params_(kept_or(defaults, store_)),
      devices_(devices),
      keeping_(bus_.port(InnerBus::kController), {kRobot, boot, kVersionNumber}, stores.tables,
               stores.calibration),
      node_(bus_.port(InnerBus::kBase), {kRobot, boot, kVersionNumber}, ramp_of(params_)) {
  keeping_.controller().node().begin_with(params_);
  adopt();
}

bool WholeRobot::adopt() noexcept {
  params_ = keeping_.controller().node().params();
  node_.brake_by(ramp_of(params_));
  base_ = &room_for_base_.make<Base>(node_, devices_.rangefinders, devices_.drive,
                                     params_.bumper.fitted == Fitted::yes ? devices_.bumper : nullptr,
                                     params_.gyro.fitted == Fitted::yes ? devices_.gyro : nullptr);
  return true;
}

bool WholeRobot::drives() const noexcept {
  return node_.state() == can::NodeState::running && status().decision.outcome == planning::Outcome::running;
}

void WholeRobot::on_press(hal::Press press) noexcept {
  if (press == hal::Press::none) return;
  if (drives()) {
    wish_ = Wish::stop;
  } else {
    wish_ = press == hal::Press::brief ? Wish::ahead : Wish::spin;
  }
}

/// The controller keeps what a calibration has found when it gets the next order.
void WholeRobot::see_end() noexcept {
  const bool ended = status().decision.outcome != planning::Outcome::running;
  if (calibrates(given_) && node_.order_state() == can::OrderState::accepted && node_.answered(tick_ - 1) &&
      ended && wish_ == Wish::none) {
    wish_ = Wish::stop;
  }
}

void WholeRobot::give(can::Order order, Length ahead) noexcept {
  given_ = order;
  node_.give(order, {{}, {{ahead, Length{}}, kTolerance}}, can::SyncMode::real_time);
}

bool WholeRobot::sensors_measure() noexcept {
  hal::RangeReadings readings{};
  if (!devices_.rangefinders.read(readings)) return false;
  for (const hal::RangeReading& reading : readings.beam) {
    if (reading.status == hal::RangeStatus::stale) return false;
  }
  return true;
}

/// The next order of the base, once the last one is answered.
void WholeRobot::follow() noexcept {
  if (node_.state() != can::NodeState::safe_stop && node_.state() != can::NodeState::ready)
    stopped_ms_ = now_ms_;
  if (!node_.matched() || node_.order_state() == can::OrderState::waiting) return;
  if (wish_ == Wish::none && now_ms_ - stopped_ms_ >= kRest_ms && status().health.fault == Fault::none)
    wish_ = Wish::rest;
  const Wish wish = wish_;
  wish_ = wish == Wish::stop ? Wish::rest : Wish::none;
  switch (wish) {
    case Wish::none: break;
    case Wish::rest: give(can::Order::start, Length{}); break;
    case Wish::ahead: give(can::Order::start, kAhead); break;
    case Wish::spin: give(can::Order::spin, Length{}); break;
    case Wish::stop: give(can::Order::cancel, Length{}); break;
  }
}

bool WholeRobot::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  keeping_.controller().poll(now_ms);
  node_.poll(now_ms);
  measures_ = measures_ || now_ms >= kSensorsStart_ms || sensors_measure();
  if (!measures_) return false;
  on_press(devices_.button.take());
  see_end();
  const uint32_t commits = keeping_.controller().node().commits();
  if (commits != commits_) {
    commits_ = commits;
    must_adopt_ = true;
    wish_ = Wish::stop;
  }
  // The order to stop has been executed: nothing drives while the program stands still.
  const bool at_rest = given_ == can::Order::cancel && node_.order_state() == can::OrderState::accepted;
  if (must_adopt_ && at_rest && wish_ != Wish::stop) {
    must_adopt_ = false;
    store_.save(keeping_.controller().node().params());
    return adopt();
  }
  follow();
  return false;
}

void WholeRobot::tick(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  base_->measure(tick_++, static_cast<uint8_t>(params_.safety.period.raw()));
  base_->publish(can::SyncMode::real_time);
  keeping_.controller().poll(now_ms);
  node_.poll(now_ms);
  base_->drive();
}

Sign WholeRobot::sign() const noexcept {
  if (!measures_) return Sign::starts;
  if (status().health.fault != Fault::none || node_.permanent_errors() != 0) return Sign::failed;
  switch (node_.state()) {
    case can::NodeState::off_bus:
    case can::NodeState::waiting: return Sign::starts;
    case can::NodeState::safe_stop:
    case can::NodeState::e_stopped: return Sign::failed;
    case can::NodeState::ready: return Sign::rests;
    case can::NodeState::running: break;
  }
  if (!drives()) return Sign::rests;
  return calibrates(given_) ? Sign::calibrates : Sign::drives;
}

}  // namespace whisker::can_app
