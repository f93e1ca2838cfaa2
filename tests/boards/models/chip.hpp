/// The STM32F405 from its drivers' view: registers at addresses, with a model behind each peripheral. Every
/// access advances the time, because a waiting driver polls.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "hal/boards/stm32f405/io.hpp"

namespace whisker::hal::stm32f405::model {

/// A peripheral: registers that store written values, unless a model does more.
class Peripheral {
 public:
  virtual ~Peripheral() = default;
  virtual std::uint32_t load(std::uint32_t offset) { return word(offset); }
  virtual void store(std::uint32_t offset, std::uint32_t value) { word(offset) = value; }
  /// One poll period has passed.
  virtual void advance() {}
  /// False: advance() does nothing.
  virtual bool advances() const { return true; }

  std::uint32_t get(Field f) { return value(f, word(f.offset)); }
  void put(Field f, std::uint32_t v) { word(f.offset) = (word(f.offset) & ~mask(f)) | bits(f, v); }
  std::uint32_t& word(std::uint32_t offset) { return words_.at(offset / 4); }

  static constexpr std::uint32_t kSpan = 0x400;

 private:
  std::array<std::uint32_t, kSpan / 4> words_{};
};

/// load() and store() of the drivers go to the newest chip. Access to an address without a peripheral fails
/// the test, and so does an endless wait.
class Chip {
 public:
  static constexpr std::uint64_t kMostAccesses = 200000000;
  /// The time of one poll: Patience::kCyclesPerPoll at 16 MHz.
  static constexpr double kUsPerAccess = 0.5;

  Chip();
  ~Chip();
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// The peripheral must outlive its use by the chip. It replaces one at the same address.
  void attach(Address base, Peripheral& peripheral);
  std::uint32_t load(Address address);
  void store(Address address, std::uint32_t value);

  std::uint64_t accesses() const { return accesses_; }
  double now_us() const { return static_cast<double>(accesses_) * kUsPerAccess; }
  static Chip& current();

 private:
  Peripheral* find(Address address, std::uint32_t& offset);
  std::map<Address, Peripheral*> peripherals_;
  std::vector<Peripheral*> advancing_;
  std::uint64_t accesses_ = 0;
  Chip* before_;
};

}  // namespace whisker::hal::stm32f405::model
