// Arm's MPS2 board in QEMU: mps2-an385 (Cortex-M3), -an386 (M4), -an500 (M7) and -an505 (M33).
#include "hal/board.hpp"
#include "hal/emulated/common/counter_meter.hpp"
#include "hal/emulated/common/milliseconds.hpp"
#include "hal/emulated/common/semihosting.hpp"
#include "hal/emulated/common/uart_port.hpp"
#include "hal/emulated/mps2/cmsdk_timer.hpp"
#include "hal/emulated/mps2/cmsdk_uart.hpp"

namespace whisker::hal {
namespace {

#ifdef WHISKER_MPS2_SECURE  // an505: the secure alias of its peripherals
using Uart = mcu::CmsdkUart<0x50200000>;
using Timer = mcu::CmsdkTimer<0x50000000, 20000000>;
#else
using Uart = mcu::CmsdkUart<0x40004000>;
using Timer = mcu::CmsdkTimer<0x40000000, 25000000>;
#endif

mcu::Milliseconds<Timer> clock;
mcu::UartPort<Uart> uart;
mcu::SemihostStream host;
mcu::CounterMeter<Timer> meter;
const Board kBoard{clock, uart, &uart, host, meter};
bool started = false;

}  // namespace

const Board& board() noexcept {
  if (!started) {
    started = true;
    Uart::start();
    Timer::start();
  }
  return kBoard;
}

void leave(int status) noexcept { mcu::semihost_exit(status); }

}  // namespace whisker::hal
