#pragma once

#include "hal/rangefinders.hpp"

namespace whisker::hal::mcu {

/// Two sets of rangefinders that look the same ways: a beam shows the nearer of its two sensors.
///
/// The first set leads: it says when there is a new measurement, and a beam that it has lost is lost. The
/// second can only bring things nearer, so its failure costs its warning and nothing else.
class Nearer final : public hal::Rangefinders {
 public:
  /// Both must outlive it.
  Nearer(hal::Rangefinders& leading, hal::Rangefinders& second) noexcept
      : leading_(leading), second_(second) {}

  bool read(hal::RangeReadings& out) noexcept override;

 private:
  hal::Rangefinders& leading_;
  hal::Rangefinders& second_;
};

}  // namespace whisker::hal::mcu
