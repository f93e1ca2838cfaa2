#include "hal/boards/common/governor.hpp"

namespace whisker::hal::mcu {
namespace {

constexpr int32_t kFarthest = 20000000;  // 0.1 um, the farthest that a wheel can roll between two steps

int32_t within(int32_t x, int32_t limit) noexcept { return x > limit ? limit : x < -limit ? -limit : x; }

}  // namespace

Governor::Governor(const MotorParams& params) noexcept
    : params_(params), way_per_count_(10000000 / params.counts_per_metre) {}

int16_t Governor::step(int16_t wanted, int16_t counted, uint8_t elapsed_ms) noexcept {
  const int32_t rolled = way_per_count_ * within(counted, kFarthest / way_per_count_);
  // 0.1 mm/s for 1 ms is 0.1 um.
  lag_ += int32_t{wanted_} * elapsed_ms - rolled;
  lag_ = within(lag_, params_.most_lag);
  wanted_ = wanted;
  if (wanted == 0) {
    lag_ = 0;
    return 0;
  }
  const int32_t speed = within(wanted + lag_ * params_.stiffness_per_s / 1000, params_.full_speed);
  return static_cast<int16_t>(speed * kFullDuty / params_.full_speed);
}

}  // namespace whisker::hal::mcu
