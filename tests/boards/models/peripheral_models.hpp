/// The small peripherals, each as its driver sees it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "hal/boards/stm32f405/reg/adc.hpp"
#include "hal/boards/stm32f405/reg/flash.hpp"
#include "hal/boards/stm32f405/reg/gpio.hpp"
#include "hal/boards/stm32f405/reg/iwdg.hpp"
#include "hal/boards/stm32f405/reg/rcc.hpp"
#include "hal/boards/stm32f405/reg/rng.hpp"
#include "hal/boards/stm32f405/reg/tim.hpp"
#include "hal/boards/stm32f405/reg/usart.hpp"
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

/// Oscillators and the clock switch, each with a possible fault.
class RccModel : public Peripheral {
 public:
  RccModel() { word(rcc::kCr.offset) = 0x83; }

  void advance() override {
    put(rcc::kHserdy, get(rcc::kHseon) != 0 && !dead_crystal && ++crystal_ > 1000 ? 1 : 0);
    const bool source = get(rcc::kPllsrc) == 0 || get(rcc::kHserdy) != 0;
    put(rcc::kPllrdy, get(rcc::kPllon) != 0 && source && !pll_without_lock && ++pll_ > 100 ? 1 : 0);
    if (switch_stuck) return;
    const std::uint32_t wanted = get(rcc::kSw);
    if (wanted != 2 || get(rcc::kPllrdy) != 0) put(rcc::kSws, wanted);
  }
  /// Core clock for the current set-up; 0 if the data sheet forbids it.
  double core_mhz(RccModel& rcc, Peripheral& flash) {
    if (rcc.get(rcc::kSws) == 0) return 16;
    const double input = get(rcc::kPllsrc) != 0 ? 8 : 16;
    const double vco_in = input / get(rcc::kPllm);
    const double vco = vco_in * get(rcc::kPlln);
    const double core = vco / (2 * (get(rcc::kPllp) + 1));
    const bool allowed = vco_in >= 1 && vco_in <= 2 && vco >= 100 && vco <= 432 && core <= 168 &&
                         core <= 30 * (flash.get(flash::kLatency) + 1);
    return allowed ? core : 0;
  }
  double bus_mhz(double core, Field prescaler) {
    const std::uint32_t code = get(prescaler);
    return code < 4 ? core : core / (2 << (code - 4));
  }

  bool dead_crystal = false;
  bool pll_without_lock = false;
  bool switch_stuck = false;

 private:
  int crystal_ = 0;
  int pll_ = 0;
};

/// A port: outputs drive their pins, and the outside may hold a pin low.
class GpioModel : public Peripheral {
 public:
  enum Mode : std::uint32_t { kInput = 0, kOutput = 1, kFunction = 2, kAnalogue = 3 };

  std::uint32_t load(std::uint32_t offset) override {
    if (offset != of_pin(gpio::kIdr, 0).offset) return word(offset);
    std::uint32_t levels = 0;
    for (std::uint8_t pin = 0; pin < 16; ++pin) levels |= (level(pin) ? 1U : 0U) << pin;
    return levels;
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset != gpio::kBsrr.offset) {
      word(offset) = value;
      return;
    }
    const std::uint32_t before = driven_;
    driven_ = (driven_ & ~(value >> 16)) | (value & 0xFFFF);
    for (std::uint8_t pin = 0; pin < 16; ++pin) {
      if (((driven_ & ~before) >> pin & 1U) != 0 && on_rise) on_rise(pin);
    }
  }

  Mode mode(std::uint8_t pin) { return static_cast<Mode>(get(of_pin(gpio::kModer, pin))); }
  bool open_drain(std::uint8_t pin) { return get(of_pin(gpio::kOtyper, pin)) != 0; }
  bool pulled_up(std::uint8_t pin) { return get(of_pin(gpio::kPupdr, pin)) == 1; }
  std::uint32_t function(std::uint8_t pin) { return get(of_pin(pin < 8 ? gpio::kAfrl : gpio::kAfrh, pin)); }
  /// The level that the port drives as an output.
  bool output(std::uint8_t pin) { return mode(pin) == kOutput && (driven_ >> pin & 1U) != 0; }
  bool level(std::uint8_t pin) {
    if (held_low && held_low(pin)) return false;
    return mode(pin) != kOutput || output(pin);
  }

  std::function<bool(std::uint8_t)> held_low;
  std::function<void(std::uint8_t)> on_rise;

 private:
  std::uint32_t driven_ = 0;
};

/// Its values are writable only while unlocked, and take effect after a delay.
class IwdgModel : public Peripheral {
 public:
  IwdgModel() { word(iwdg::kRlr.offset) = 0xFFF; }

  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset == iwdg::kKr.offset) {
      if (value == 0xCCCC) running = true;
      if (value == 0xAAAA) {
        ++feedings;
        hungry_us_ = 0;
        loaded_ms_ = timeout_ms();
      }
      unlocked_ = value == 0x5555;
      return;
    }
    const Field busy = offset == iwdg::kPr.offset ? iwdg::kPvu : iwdg::kRvu;
    if (!unlocked_ || get(busy) != 0) return;
    word(offset) = value;
    put(busy, 1);
    left_ = 200;
  }
  void advance() override {
    if (running) {
      hungry_us_ += Chip::kUsPerAccess;
      hungriest = std::max(hungriest, hungry_us_ / (1000 * loaded_ms_));
    }
    if (!running || never_ready || left_ == 0 || --left_ > 0) return;
    put(iwdg::kPvu, 0);
    put(iwdg::kRvu, 0);
  }
  double timeout_ms() { return (word(iwdg::kRlr.offset) + 1.0) * (4 << word(iwdg::kPr.offset)) / 32.0; }

  bool running = false;
  int feedings = 0;
  double hungriest = 0;  ///< largest part of the time-out that passed without a feeding
  bool never_ready = false;

 private:
  bool unlocked_ = false;
  int left_ = 0;
  double hungry_us_ = 0;
  double loaded_ms_ = 512;
};

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

class UsartModel : public Peripheral {
 public:
  static constexpr int kByte = 40;  // polls

  UsartModel() { word(usart::kSr.offset) = mask(usart::kTxe); }

  std::uint32_t load(std::uint32_t offset) override {
    if (offset == usart::kSr.offset) status_read_ = true;
    if (offset != usart::kDr.offset) return word(offset);
    if (status_read_) {
      put(usart::kOre, 0);
      put(usart::kFe, 0);
      put(usart::kNf, 0);
    }
    status_read_ = false;
    put(usart::kRxne, 0);
    return received_;
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset != usart::kDr.offset) {
      word(offset) = value;
      return;
    }
    if (get(usart::kTxe) == 0 || get(usart::kTe) == 0 || get(usart::kUe) == 0) return;
    sent += static_cast<char>(value);
    put(usart::kTxe, 0);
    left_ = kByte;
  }
  void advance() override {
    if (!line_held && left_ > 0 && --left_ == 0) put(usart::kTxe, 1);
  }
  /// A byte arrives. Returns whether the interrupt is raised.
  bool receive(std::uint8_t byte, bool noisy = false) {
    if (get(usart::kRe) == 0 || get(usart::kUe) == 0) return false;
    if (get(usart::kRxne) != 0) {
      put(usart::kOre, 1);
    } else {
      received_ = byte;
      put(usart::kRxne, 1);
      put(usart::kNf, noisy ? 1 : 0);
    }
    return get(usart::kRxneie) != 0;
  }
  double baud(double clock_hz) {
    return clock_hz / (16 * (get(usart::kMantissa) + get(usart::kFraction) / 16.0));
  }

  std::string sent;
  bool line_held = false;  // sent bytes do not leave

 private:
  bool status_read_ = false;
  std::uint32_t received_ = 0;
  int left_ = 0;
};

}  // namespace whisker::hal::stm32f405::model
