#include "firmware/can/input_set.hpp"

namespace whisker::can {
namespace {

constexpr uint8_t kWheels = 1 << hal::kBeams;
constexpr uint8_t kSynced = kWheels << 1;
constexpr uint8_t kAll = (kSynced << 1) - 1;
constexpr uint8_t kGyro = kSynced << 1;
using Any = Range<MessageKind::range_left>;

}  // namespace

bool InputSets::sound(hal::RangeReading& wire) noexcept {
  switch (wire.status) {
    case hal::RangeStatus::ok: return wire.mm < Any::kNone;
    case hal::RangeStatus::clear:
      if (wire.mm != Any::kClear) return false;
      break;
    case hal::RangeStatus::too_near:
    case hal::RangeStatus::invalid:
    case hal::RangeStatus::stale:
      if (wire.mm != Any::kNone) return false;
      break;
  }
  wire.mm = 0;
  return true;
}

hal::RangeReading InputSets::to_wire(const hal::RangeReading& reading) noexcept {
  hal::RangeReading wire = reading;
  wire.sequence &= 0x0F;
  // A damaged reading must not look valid.
  if (wire.status > hal::RangeStatus::stale ||
      (wire.status == hal::RangeStatus::ok && wire.mm >= Any::kNone)) {
    wire.status = hal::RangeStatus::invalid;
  }
  if (wire.status != hal::RangeStatus::ok) {
    wire.mm = wire.status == hal::RangeStatus::clear ? Any::kClear : Any::kNone;
  }
  return wire;
}

void InputSets::on_frame(int beam, const hal::RangeReading& reading, uint16_t tick, BumpState bump) noexcept {
  bumps_[beam] = bump;
  ranges_.beam[beam] = reading;
  range_tick_[beam] = tick;
  seen_ = static_cast<uint8_t>(seen_ | 1 << beam);
}

void InputSets::on_frame(const WheelState& state) noexcept {
  wheels_ = state;
  seen_ |= kWheels;
}

void InputSets::on_frame(const GyroState& state) noexcept {
  gyro_ = state;
  seen_ |= kGyro;
}

void InputSets::on_frame(const Sync& sync) noexcept {
  sync_ = sync;
  seen_ |= kSynced;
}

bool InputSets::complete() const noexcept {
  const uint32_t tick = sync_.tick % WheelState::kTickModulus;
  const auto tick16 = static_cast<uint16_t>(sync_.tick);
  if ((seen_ & kAll) != kAll || wheels_.tick != tick) return false;
  if (sync_.gyro != 0 && ((seen_ & kGyro) == 0 || gyro_.tick != tick)) return false;
  if (sync_.fix != 0 && !fix_.complete(tick16)) return false;
  for (const uint16_t of_range : range_tick_) {
    if (of_range != tick16) return false;
  }
  return true;
}

InputSet InputSets::set() const noexcept {
  InputSet set{sync_.tick,     sync_.period_ms,    ranges_,
               wheels_.counts, wheels_.valid != 0, {bumps_[0], bumps_[1], bumps_[2]}};
  set.has_gyro = sync_.gyro != 0;
  set.gyro_valid = set.has_gyro && gyro_.valid != 0;
  set.gyro = gyro_.reading;
  set.has_fix = sync_.fix != 0;
  if (set.has_fix) set.fix = fix_.fix();
  return set;
}

}  // namespace whisker::can
