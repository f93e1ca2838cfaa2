#pragma once

#include "hal/rangefinders.hpp"

namespace whisker::hal::mcu {

/// Two sets of rangefinders that look in the same directions: a beam returns the nearer of its two sensors.
///
/// The first set is primary: it decides when there is a new measurement and whether a beam is lost. The
/// second set can only shorten distances, so its failure loses only its warnings.
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
