// Arm's MPS2 board as QEMU has it: mps2-an385 (Cortex-M3), -an386 (M4), -an500 (M7) and -an505 (M33).
#include "hal/board.hpp"
#include "hal/mcu/common/milliseconds.hpp"
#include "hal/mcu/common/semihosting.hpp"
#include "hal/mcu/common/uart_port.hpp"
#include "hal/mcu/cortex_m/systick_meter.hpp"
#include "hal/mcu/mps2/cmsdk_timer.hpp"
#include "hal/mcu/mps2/cmsdk_uart.hpp"

namespace whisker::hal::mcu {
namespace {

#ifdef WHISKER_MPS2_SECURE  // an505: the secure alias of its peripherals
constexpr uint32_t kHertz = 20000000;
using Uart = CmsdkUart<0x50200000>;
using Timer = CmsdkTimer<0x50000000, kHertz>;
#else
constexpr uint32_t kHertz = 25000000;
using Uart = CmsdkUart<0x40004000>;
using Timer = CmsdkTimer<0x40000000, kHertz>;
#endif

Milliseconds<Timer> clock;
UartPort<Uart> uart;
SemihostStream host;
SysTickMeter<kHertz> meter;
const Board kBoard{clock, uart, uart, host, meter};
bool started = false;

}  // namespace
}  // namespace whisker::hal::mcu

namespace whisker::hal {

using namespace mcu;

const Board& board() noexcept {
  if (!started) {
    started = true;
    Uart::start();
    Timer::start();
    meter.start();
  }
  return kBoard;
}

void leave(int status) noexcept { semihost_exit(status); }

}  // namespace whisker::hal
