#include "hal/boards/stm32f405/usart.hpp"

#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/usart.hpp"

namespace whisker::hal::stm32f405 {

void Usart::start(uint32_t baud, const Clocks& clocks) noexcept {
  const uint32_t sixteenths = (clocks.apb1_hz + baud / 2) / baud;
  store(base::kUsart2, usart::kBrr,
        bits(usart::kMantissa, sixteenths / 16) | bits(usart::kFraction, sixteenths % 16));
  store(base::kUsart2, usart::kCr1,
        bits(usart::kUe, 1) | bits(usart::kTe, 1) | bits(usart::kRe, 1) | bits(usart::kRxneie, 1));
}

bool Usart::offer(uint8_t byte) noexcept {
  if (!is_set(base::kUsart2, usart::kTxe)) return false;
  store(base::kUsart2, usart::kDr, byte);
  return true;
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
  // Reading the data after the status clears the flags, including error flags.
  const uint8_t byte = static_cast<uint8_t>(load(base::kUsart2, usart::kDr));
  if ((status & mask(usart::kOre)) != 0) lost_.happened();
  if ((status & mask(usart::kRxne)) == 0) return;
  if ((status & kDamaged) != 0 || !received_.push(byte)) lost_.happened();
}

}  // namespace whisker::hal::stm32f405
