// QEMU's RISC-V board "virt".
#include "hal/board.hpp"
#include "hal/emulated/common/milliseconds.hpp"
#include "hal/emulated/common/semihosting.hpp"
#include "hal/emulated/common/uart_port.hpp"
#include "hal/emulated/virt/instruction_meter.hpp"
#include "hal/emulated/virt/machine_timer.hpp"
#include "hal/emulated/virt/ns16550.hpp"

namespace whisker::hal {
namespace {

mcu::Milliseconds<mcu::MachineTimer> clock;
mcu::UartPort<mcu::Ns16550> uart;
mcu::SemihostStream host;
mcu::InstructionMeter meter;
const Board kBoard{clock, uart, &uart, host, meter};

}  // namespace

const Board& board() noexcept { return kBoard; }

/// Exits through the board's test device, so that programs without semihosting work too.
void leave(int status) noexcept {
  constexpr uint32_t kPass = 0x5555;
  constexpr uint32_t kFail = 0x3333;
  mcu::reg(0x00100000) = status == 0 ? kPass : kFail | static_cast<uint32_t>(status) << 16;
  for (;;) {
  }
}

}  // namespace whisker::hal
