#include "hal/boards/atmega1284p/encoders.hpp"

#include "hal/boards/atmega1284p/pins.hpp"
#include "hal/boards/common/counts.hpp"

namespace whisker::hal::atmega1284p {
namespace {

constexpr uint8_t kInputs = wiring::kLeftA | wiring::kLeftB | wiring::kRightA | wiring::kRightB;

/// Forward, A leads B: at an edge of A the two differ afterwards, at an edge of B they agree.
[[gnu::always_inline]] inline bool follow(uint16_t& counter, uint8_t changed, uint8_t pins, uint8_t a,
                                          uint8_t b) noexcept {
  const bool a_changed = (changed & a) != 0;
  const bool b_changed = (changed & b) != 0;
  if (a_changed == b_changed) return !a_changed;
  const bool differ = ((pins & a) != 0) != ((pins & b) != 0);
  counter = static_cast<uint16_t>(differ == a_changed ? counter + 1 : counter - 1);
  return true;
}

}  // namespace

void Encoders::start() noexcept {
  set(reg::kPORTD, kInputs);
  pins_ = load(reg::kPIND);
  store(reg::kPCMSK2, kInputs);
  set(reg::kPCICR, bits::kPCIE2);
}

void Encoders::on_interrupt() noexcept {
  const uint8_t pins = load(reg::kPIND);
  const uint8_t changed = pins ^ pins_;
  pins_ = pins;
  const bool left = follow(now_.left, changed, pins, wiring::kLeftA, wiring::kLeftB);
  const bool right = follow(now_.right, changed, pins, wiring::kRightA, wiring::kRightB);
  if (!left || !right) skipped_.happened();
  shared_.publish(now_);
}

bool Encoders::read(EncoderCounts& out) noexcept {
  const uint8_t skipped = skipped_.collect();
  if (skipped != 0) troubles_.count(Trouble::encoder_skipped, skipped);
  Counters counters;
  if (!shared_.read(counters)) return false;
  counts_.left = mcu::follow_counter(counts_.left, counters.left);
  counts_.right = mcu::follow_counter(counts_.right, counters.right);
  out = counts_;
  return true;
}

}  // namespace whisker::hal::atmega1284p
