#include "hal/boards/atmega1284p/motors.hpp"

#include "hal/boards/atmega1284p/pins.hpp"

namespace whisker::hal::atmega1284p {
namespace {

void drive_one(Register port, uint8_t forward, uint8_t backward, Register pulse, int16_t duty) noexcept {
  // The input to be low goes low first: both high would be a short pulse of the wrong kind.
  if (duty <= 0) clear(port, forward);
  if (duty >= 0) clear(port, backward);
  const uint16_t size =
      static_cast<uint16_t>(duty < 0 ? 0U - static_cast<uint16_t>(duty) : static_cast<uint16_t>(duty));
  store(pulse, static_cast<uint8_t>(size >= 0x7F80 ? 0xFF : (size + 0x40) >> 7));
  if (duty > 0) set(port, forward);
  if (duty < 0) set(port, backward);
}

}  // namespace

void Motors::start() noexcept {
  using namespace wiring;
  drive(0, 0);
  set(reg::kDDRB, kLeftForward | kLeftBackward);
  set(reg::kDDRC, kRightForward | kRightBackward);
  store(reg::kTCCR0A, bits::kCOM0A1 | bits::kCOM0B1 | bits::kWGM01 | bits::kWGM00);
  store(reg::kTCCR0B, bits::kCS01);
  set(reg::kDDRD, kPulses);
}

void Motors::drive(int16_t left, int16_t right) noexcept {
  using namespace wiring;
  drive_one(reg::kPORTB, kLeftForward, kLeftBackward, reg::kOCR0A, left);
  drive_one(reg::kPORTC, kRightForward, kRightBackward, reg::kOCR0B, right);
}

}  // namespace whisker::hal::atmega1284p
