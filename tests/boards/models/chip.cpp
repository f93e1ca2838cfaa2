#include "tests/boards/models/chip.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iterator>

namespace whisker::hal::mcu {

std::uint32_t load(Address address) noexcept { return stm32f405::model::Chip::current().load(address); }
void store(Address address, std::uint32_t value) noexcept {
  stm32f405::model::Chip::current().store(address, value);
}

}  // namespace whisker::hal::mcu

namespace whisker::hal::stm32f405 {
namespace model {
namespace {

Chip* chip = nullptr;

}  // namespace

Chip::Chip() : before_(chip) { chip = this; }
Chip::~Chip() { chip = before_; }
Chip& Chip::current() { return *chip; }

void Chip::attach(Address base, Peripheral& peripheral) {
  peripherals_[base] = &peripheral;
  advancing_.clear();
  for (const auto& [at, attached] : peripherals_) {
    if (attached->advances()) advancing_.push_back(attached);
  }
}

Peripheral* Chip::find(Address address, std::uint32_t& offset) {
  if (++accesses_ > kMostAccesses) {
    ADD_FAILURE() << "a driver waits for ever";
    std::abort();
  }
  for (Peripheral* const peripheral : advancing_) peripheral->advance();
  const auto after = peripherals_.upper_bound(address);
  if (after != peripherals_.begin()) {
    const auto& [base, peripheral] = *std::prev(after);
    offset = address - base;
    if (offset < Peripheral::kSpan) return peripheral;
  }
  ADD_FAILURE() << std::hex << "no peripheral at " << address;
  return nullptr;
}

std::uint32_t Chip::load(Address address) {
  std::uint32_t offset = 0;
  Peripheral* const peripheral = find(address, offset);
  return peripheral == nullptr ? 0 : peripheral->load(offset);
}

void Chip::store(Address address, std::uint32_t value) {
  std::uint32_t offset = 0;
  Peripheral* const peripheral = find(address, offset);
  if (peripheral != nullptr) peripheral->store(offset, value);
}

}  // namespace model
}  // namespace whisker::hal::stm32f405
