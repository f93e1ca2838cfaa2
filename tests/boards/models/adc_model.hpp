#pragma once

#include <functional>

#include "hal/boards/stm32f405/reg/adc.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// Converts one channel at a time, the first of the sequence.
class AdcModel : public Peripheral {
 public:
  std::uint32_t load(std::uint32_t offset) override {
    if (offset == adc::kDr.offset) put(adc::kEoc, 0);
    return word(offset);
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset == adc::kSr.offset) {
      word(offset) &= value;
      return;
    }
    word(offset) = value;
    if (get(adc::kSwstart) == 0) return;
    put(adc::kSwstart, 0);
    // A start during a conversion restarts it.
    left_ = get(adc::kAdon) != 0 ? kConversion : 0;
  }
  void advance() override {
    if (never_ends || left_ == 0 || --left_ > 0) return;
    word(adc::kDr.offset) = static_cast<std::uint32_t>(raw(get(adc::kSq1)));
    put(adc::kEoc, 1);
  }

  std::function<int(std::uint32_t channel)> raw = [](std::uint32_t) { return 0; };
  bool never_ends = false;

 private:
  static constexpr int kConversion = 20;
  int left_ = 0;
};

}  // namespace whisker::hal::stm32f405::model
