#include "hal/mcu/stm32f405/usart.hpp"

#include "hal/mcu/stm32f405/patience.hpp"
#include "hal/mcu/stm32f405/reg/bases.hpp"
#include "hal/mcu/stm32f405/reg/usart.hpp"

namespace whisker::stm32f405 {

void Usart::start(uint32_t baud, const Clocks& clocks) noexcept {
  core_hz_ = clocks.core_hz;
  byte_us_ = 10 * 1000000 / baud + 1;
  const uint32_t sixteenths = (clocks.apb1_hz + baud / 2) / baud;
  store(base::kUsart2, usart::kBrr,
        bits(usart::kMantissa, sixteenths / 16) | bits(usart::kFraction, sixteenths % 16));
  store(base::kUsart2, usart::kCr1,
        bits(usart::kUe, 1) | bits(usart::kTe, 1) | bits(usart::kRe, 1) | bits(usart::kRxneie, 1));
}

bool Usart::send(uint8_t byte, Troubles& troubles) noexcept {
  if (!Patience::for_us(3 * byte_us_, core_hz_).until(base::kUsart2, usart::kTxe, true)) {
    troubles.count(Trouble::usart_send_timeout);
    return false;
  }
  store(base::kUsart2, usart::kDr, byte);
  return true;
}

void Usart::send(const char* text, Troubles& troubles) noexcept {
  // One that does not leave is enough to know: the rest would only wait as long again.
  while (*text != '\0' && send(static_cast<uint8_t>(*text), troubles)) ++text;
}

void Usart::send_number(uint32_t number, Troubles& troubles) noexcept {
  char digits[11];
  uint8_t at = sizeof digits - 1;
  digits[at] = '\0';
  do {
    digits[--at] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  send(&digits[at], troubles);
}

bool Usart::receive(uint8_t& byte, Troubles& troubles) noexcept {
  const uint8_t lost = lost_.collect();
  if (lost != 0) troubles.count(Trouble::usart_receive_lost, lost);
  return received_.pop(byte);
}

void Usart::on_interrupt() noexcept {
  const uint32_t status = load(base::kUsart2, usart::kSr);
  constexpr uint32_t kDamaged = mask(usart::kFe) | mask(usart::kNf);
  constexpr uint32_t kAny = mask(usart::kRxne) | mask(usart::kOre);
  if ((status & kAny) == 0) return;
  // Reading the data after the status clears the flags, those of errors too.
  const uint8_t byte = static_cast<uint8_t>(load(base::kUsart2, usart::kDr));
  if ((status & mask(usart::kOre)) != 0) lost_.happened();
  if ((status & mask(usart::kRxne)) == 0) return;
  if ((status & kDamaged) != 0 || !received_.push(byte)) lost_.happened();
}

}  // namespace whisker::stm32f405
