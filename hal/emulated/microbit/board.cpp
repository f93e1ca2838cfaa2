// BBC micro:bit: its nRF51822 has a Cortex-M0. QEMU has no Cortex-M0+ board; this one runs its code.
#include "hal/board.hpp"
#include "hal/emulated/common/counter_meter.hpp"
#include "hal/emulated/common/milliseconds.hpp"
#include "hal/emulated/common/semihosting.hpp"
#include "hal/emulated/common/uart_port.hpp"
#include "hal/emulated/microbit/nrf_timer.hpp"
#include "hal/emulated/microbit/nrf_uart.hpp"

namespace whisker::hal {
namespace {

mcu::Milliseconds<mcu::NrfTimer> clock;
mcu::UartPort<mcu::NrfUart> uart;
mcu::SemihostStream host;
mcu::CounterMeter<mcu::NrfTimer> meter;
const Board kBoard{clock, uart, &uart, host, meter};
bool started = false;

}  // namespace

const Board& board() noexcept {
  if (!started) {
    started = true;
    mcu::NrfUart::start();
    mcu::NrfTimer::start();
  }
  return kBoard;
}

void leave(int status) noexcept { mcu::semihost_exit(status); }

}  // namespace whisker::hal
