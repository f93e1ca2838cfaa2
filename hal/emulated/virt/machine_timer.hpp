#pragma once

#include "hal/runtime/registers.hpp"

namespace whisker::hal::mcu {

/// The lower half of mtime in the CLINT of QEMU's virt board.
struct MachineTimer {
  static constexpr uint32_t kPerMillisecond = 10000;
  static uint32_t now() noexcept { return reg(0x0200BFF8); }
};

}  // namespace whisker::hal::mcu
