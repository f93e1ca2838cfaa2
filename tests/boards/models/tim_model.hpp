#pragma once

#include "hal/boards/stm32f405/reg/tim.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// A timer as a clock, as a pulse width, or as a quadrature counter.
class TimModel : public Peripheral {
 public:
  /// 0: the counter does not advance with time.
  explicit TimModel(double input_mhz = 0) : input_mhz_(input_mhz) {}

  void store(std::uint32_t offset, std::uint32_t value) override {
    word(offset) = value;
    // The prescaler takes effect at an update.
    if (offset == tim::kEgr.offset && (value & mask(tim::kUg)) != 0) {
      prescaler_ = word(tim::kPsc.offset);
      clocks_ = 0;
      word(tim::kCnt.offset) = 0;
    }
  }
  void advance() override {
    if (input_mhz_ == 0 || get(tim::kCen) == 0) return;
    clocks_ += input_mhz_ * Chip::kUsPerAccess;
    while (clocks_ >= prescaler_ + 1.0) {
      clocks_ -= prescaler_ + 1.0;
      ++word(tim::kCnt.offset);
    }
  }
  /// The wheel turns by so many encoder edges.
  void turn(int edges) {
    const bool counts = get(tim::kCen) != 0 && get(tim::kSms) == 3 && get(tim::kCc1s) == 1 &&
                        get(tim::kCc2s) == 1 && word(tim::kArr.offset) == 0xFFFF;
    if (!counts) return;
    std::uint32_t& count = word(tim::kCnt.offset);
    count = (count + static_cast<std::uint32_t>(edges)) & 0xFFFF;
  }
  /// Fraction of the period with high output; 0 if the output is off.
  double duty(int channel) {
    const bool first = channel == 1;
    const bool on = get(tim::kCen) != 0 && get(tim::kMoe) != 0 && get(first ? tim::kCc1e : tim::kCc2e) != 0 &&
                    get(first ? tim::kOc1m : tim::kOc2m) == 6 && get(first ? tim::kCc1p : tim::kCc2p) == 0;
    if (!on) return 0;
    const double high = word((first ? tim::kCcr1 : tim::kCcr2).offset);
    const double period = word(tim::kArr.offset) + 1.0;
    return high > period ? 1 : high / period;
  }
  double period_clocks() { return (word(tim::kArr.offset) + 1.0) * (prescaler_ + 1.0); }

 private:
  double input_mhz_;
  double clocks_ = 0;
  double prescaler_ = 0;
};

}  // namespace whisker::hal::stm32f405::model
