#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/flash.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// The flash interface: locked until the keys come, and busy for a while after each command.
class FlashModel : public Peripheral {
 public:
  FlashModel() { put(flash::kLock, 1); }

  void store(std::uint32_t offset, std::uint32_t value) override {
    if (offset == flash::kKeyr.offset) {
      if (value == 0xCDEF89AB && key_ == 0x45670123 && !jammed) put(flash::kLock, 0);
      key_ = value;
    } else if (offset == flash::kSr.offset) {
      word(offset) &= ~value;
    } else if (offset != flash::kCr.offset) {
      Peripheral::store(offset, value);
    } else if (get(flash::kLock) == 0) {
      word(offset) = value & ~mask(flash::kStrt);
      if ((value & mask(flash::kStrt)) != 0 && get(flash::kSer) != 0) start_erase();
    }
  }
  void advance() override {
    if (busy_ > 0 && !stuck && --busy_ == 0) put(flash::kBsy, 0);
  }
  /// False: refused with an error bit.
  bool begin_word() {
    if (power == 0) return false;
    if (get(flash::kLock) != 0 || get(flash::kPg) == 0 || get(flash::kBsy) != 0) {
      put(flash::kPgserr, 1);
    } else if (get(flash::kPsize) != 2) {
      put(flash::kPgperr, 1);
    } else if (write_protected) {
      put(flash::kWrperr, 1);
    } else {
      if (power > 0) --power;
      begin(40);
      return true;
    }
    return false;
  }
  std::array<int, 12> erasures{};  ///< of each sector
  std::function<void()> on_erase;
  std::array<int, 12> torn{};  ///< of the erasures: the power failed meanwhile
  int erase_accesses = 2000;   ///< how long an erasure takes
  int power = -1;              ///< erasures and words until it fails; -1: never
  bool stuck = false;
  bool jammed = false;
  bool write_protected = false;

 private:
  void start_erase() {
    if (write_protected) return put(flash::kWrperr, 1);
    ++erasures.at(get(flash::kSnb));
    if (power == 0) ++torn.at(get(flash::kSnb));
    if (power > 0) --power;
    if (on_erase) on_erase();
    begin(erase_accesses);
  }
  void begin(int accesses) {
    put(flash::kBsy, 1);
    busy_ = accesses;
  }
  std::uint32_t key_ = 0;
  int busy_ = 0;
};

/// A part of a sector: bits are cleared by writing, and set by erasing the sector.
class FlashPage : public Peripheral {
 public:
  FlashPage(FlashModel& flash, std::size_t sector) : flash_(flash), sector_(sector) {}
  std::uint32_t load(std::uint32_t offset) override {
    follow();
    return word(offset);
  }
  void store(std::uint32_t offset, std::uint32_t value) override {
    follow();
    if (flash_.begin_word()) word(offset) &= value;
  }
  bool advances() const override { return false; }

 private:
  void follow() {
    if (flash_.erasures.at(sector_) == seen_) return;
    seen_ = flash_.erasures.at(sector_);
    const bool torn = flash_.torn.at(sector_) != torn_;
    torn_ = flash_.torn.at(sector_);
    for (std::uint32_t i = 0; i < kSpan; i += torn ? 8 : 4) word(i) = UINT32_MAX;
  }
  FlashModel& flash_;
  const std::size_t sector_;
  int seen_ = 0;
  int torn_ = 0;
};

/// The flash interface, and the first `bytes` of the last four sectors.
struct FlashMemory {
  FlashMemory(Chip& chip, Address bytes) {
    chip.attach(base::kFlash, model);
    for (std::size_t sector = 8; sector < 12; ++sector) {
      for (Address at = 0; at < bytes; at += Peripheral::kSpan) {
        chip.attach(static_cast<Address>(0x08080000 + (sector - 8) * 0x20000 + at),
                    pages.emplace_back(model, sector));
      }
    }
  }
  /// What is there without power.
  using Contents = std::vector<std::uint32_t>;
  Contents contents() {
    Contents words;
    for (FlashPage& page : pages) {
      for (std::uint32_t i = 0; i < Peripheral::kSpan; i += 4) words.push_back(page.load(i));
    }
    return words;
  }
  /// As another chip of the same size left it.
  void fill(const Contents& words) {
    std::size_t at = 0;
    for (FlashPage& page : pages) {
      for (std::uint32_t i = 0; i < Peripheral::kSpan; i += 4) page.word(i) = words.at(at++);
    }
  }

  FlashModel model;
  std::deque<FlashPage> pages;
};

}  // namespace whisker::hal::stm32f405::model
