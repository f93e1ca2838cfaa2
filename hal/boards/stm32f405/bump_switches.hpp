#pragma once

#include "hal/boards/common/debounce.hpp"
#include "hal/bumper.hpp"

namespace whisker::hal::stm32f405 {

/// A bumper of two halves, wiring::kBumpers; each closes its pin to ground. A press straight ahead closes
/// both.
class BumpSwitches final : public Bumper {
 public:
  /// Call it as often as possible, and at least every 5 ms.
  void poll(uint32_t now_ms) noexcept;
  /// Never refuses.
  bool read(BumperReading& out) noexcept override;

 private:
  mcu::Debounce left_;
  mcu::Debounce right_;
};

}  // namespace whisker::hal::stm32f405
