#pragma once

#include <cstdint>

#include "hal/boards/stm32f405/reg/rng.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// The generator of random numbers: another one some time after each is read.
class RngModel : public Peripheral {
 public:
  std::uint32_t load(std::uint32_t offset) override {
    if (offset != rng::kDr.offset || get(rng::kDrdy) == 0) return word(offset);
    put(rng::kDrdy, 0);
    left_ = kAccesses;
    return stuck ? 7 : next_ = next_ * 1664525 + 1013904223;
  }
  void advance() override {
    if (!dead && get(rng::kRngen) != 0 && left_ > 0 && --left_ == 0) put(rng::kDrdy, 1);
  }
  void seed(std::uint32_t number) { next_ = number; }

  bool dead = false;   ///< no clock, or no noise
  bool stuck = false;  ///< always the same number

 private:
  static constexpr int kAccesses = 5;
  std::uint32_t next_ = 1;
  int left_ = kAccesses;
};

}  // namespace whisker::hal::stm32f405::model
