#include "hal/boards/stm32f405/encoders.hpp"

#include "hal/boards/common/counts.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/tim.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kBothEdgesOfBoth = 3;  // encoder mode 3
constexpr uint32_t kOwnInput = 1;
constexpr uint32_t kSteadyFor8 = 3;  // timer clocks: filters spikes on the wires
constexpr Address kTimers[2] = {base::kTim3, base::kTim4};

}  // namespace

void Encoders::start() noexcept {
  for (const Address timer : kTimers) {
    store(timer, tim::kArr, UINT16_MAX);
    set(timer, tim::kCc1s, kOwnInput);
    set(timer, tim::kCc2s, kOwnInput);
    set(timer, tim::kIc1f, kSteadyFor8);
    set(timer, tim::kIc2f, kSteadyFor8);
    set(timer, tim::kCc1p, 0);
    set(timer, tim::kCc2p, 0);
    set(timer, tim::kSms, kBothEdgesOfBoth);
    store(timer, tim::kCnt, 0);
    set(timer, tim::kCen, 1);
  }
}

bool Encoders::read(hal::EncoderCounts& out) noexcept {
  counts_.left = mcu::follow_counter(counts_.left, static_cast<uint16_t>(load(kTimers[0], tim::kCnt)));
  counts_.right = mcu::follow_counter(counts_.right, static_cast<uint16_t>(load(kTimers[1], tim::kCnt)));
  out = counts_;
  return true;
}

}  // namespace whisker::hal::stm32f405
