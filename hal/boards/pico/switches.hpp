#pragma once

#include "hal/boards/common/debounce.hpp"
#include "hal/boards/common/press_detector.hpp"
#include "hal/bumper.hpp"
#include "hal/button.hpp"

namespace whisker::hal::pico {

/// The two halves of a bumper, each of which closes its pin to ground.
class BumpSwitches final : public Bumper {
 public:
  /// Call it at least every 5 ms.
  void poll(uint32_t now_ms) noexcept;
  bool read(BumperReading& out) noexcept override;

 private:
  mcu::Debounce left_, right_;
};

/// The button, which closes its pin to ground. A pin without a button reports nothing.
class PushButton final : public Button {
 public:
  /// Call it at least every 5 ms.
  void poll(uint32_t now_ms) noexcept;
  Press take() noexcept override { return presses_.take(); }

 private:
  mcu::PressDetector presses_;
};

}  // namespace whisker::hal::pico
