#pragma once

#include "hal/boards/stm32f405/clock.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "tests/boards/models/can_model.hpp"
#include "tests/boards/models/i2c_model.hpp"
#include "tests/boards/models/peripheral_models.hpp"

namespace whisker::hal::stm32f405 {

/// A chip with every peripheral of the board, in its reset state.
struct ModelChip {
  ModelChip() {
    chip.attach(base::kRcc, rcc);
    chip.attach(base::kFlash, flash);
    chip.attach(base::kGpioA, gpio_a);
    chip.attach(base::kGpioB, gpio_b);
    chip.attach(base::kGpioC, gpio_c);
    chip.attach(base::kTim1, tim1);
    chip.attach(base::kTim2, tim2);
    chip.attach(base::kTim3, tim3);
    chip.attach(base::kTim4, tim4);
    chip.attach(base::kI2c1, i2c);
    chip.attach(base::kAdc1, adc);
    chip.attach(base::kAdcCommon, adc_common);
    chip.attach(base::kUsart2, usart);
    chip.attach(base::kIwdg, iwdg);
    chip.attach(base::kCan1, can);
    chip.attach(base::kNvic, nvic);
    chip.attach(base::kRng, rng);
  }

  model::Chip chip;
  model::RccModel rcc;
  model::Peripheral flash;
  model::GpioModel gpio_a, gpio_b, gpio_c;
  model::TimModel tim1;
  model::TimModel tim2{16};
  model::TimModel tim3, tim4;
  model::I2cModel i2c;
  model::AdcModel adc;
  model::Peripheral adc_common;
  model::UsartModel usart;
  model::IwdgModel iwdg;
  model::CanModel can;
  model::Peripheral nvic;
  model::RngModel rng;
  Troubles troubles;
};

}  // namespace whisker::hal::stm32f405
