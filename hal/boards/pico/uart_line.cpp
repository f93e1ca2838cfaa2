#include "hal/boards/pico/uart_line.hpp"

#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/reg/uart.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kSixtyFourths =
    (kCoreHz * 4 + UartLine::kBaud / 2) / UartLine::kBaud;  // of a sixteenth of a bit
constexpr uint32_t kEightBits = 3;
constexpr uint32_t kWhenHalfFull = 2;
constexpr uint32_t kWhenNearlyEmpty = 0;
/// Overrun, break, parity and framing errors come with the byte.
constexpr uint32_t kErrors = 0xF00;
constexpr uint32_t kReceives = mask(uart::kRxim) | mask(uart::kRtim) | mask(uart::kOeim);

}  // namespace

void UartLine::start() noexcept {
  store(base::kUart0, uart::kUartibrd, kSixtyFourths / 64);
  store(base::kUart0, uart::kUartfbrd, kSixtyFourths % 64);
  store(base::kUart0, uart::kUartlcrH, bits(uart::kWlen, kEightBits) | mask(uart::kFen));
  store(base::kUart0, uart::kUartifls,
        bits(uart::kRxiflsel, kWhenHalfFull) | bits(uart::kTxiflsel, kWhenNearlyEmpty));
  store(base::kUart0, uart::kUartcr, mask(uart::kUarten) | mask(uart::kTxe) | mask(uart::kRxe));
  store(base::kUart0, uart::kUartimsc, kReceives);
  enable(Interrupt::uart0);
}

size_t UartLine::take(uint8_t* to, size_t room) noexcept {
  size_t taken = 0;
  while (taken < room && received_.pop(to[taken])) ++taken;
  return taken;
}

size_t UartLine::offer(const uint8_t* from, size_t count) noexcept {
  size_t put = 0;
  while (put < count && out_.push(from[put])) ++put;
  // The interrupt comes when the queue becomes nearly empty, so the first bytes need a start.
  clear_bits(base::kUart0, uart::kUartimsc, mask(uart::kTxim));
  fill();
  return put;
}

void UartLine::fill() noexcept {
  uint8_t byte = 0;
  while (!is_set(base::kUart0, uart::kTxff) && out_.pop(byte)) store(base::kUart0, uart::kUartdr, byte);
  if (out_.size() != 0) set_bits(base::kUart0, uart::kUartimsc, mask(uart::kTxim));
}

void UartLine::on_interrupt() noexcept {
  const uint32_t why = load(base::kUart0, uart::kUartmis);
  store(base::kUart0, uart::kUarticr, why);
  if ((why & mask(uart::kOeim)) != 0) lost_.happened();
  while (!is_set(base::kUart0, uart::kRxfe)) {
    const uint32_t data = load(base::kUart0, uart::kUartdr);
    if ((data & kErrors) != 0 || !received_.push(static_cast<uint8_t>(data))) lost_.happened();
  }
  if ((why & mask(uart::kTxim)) == 0) return;
  clear_bits(base::kUart0, uart::kUartimsc, mask(uart::kTxim));
  fill();
}

}  // namespace whisker::hal::pico
