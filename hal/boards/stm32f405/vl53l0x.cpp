#include "hal/boards/stm32f405/vl53l0x.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using namespace vl53l0x;

bool start(I2c& bus, uint8_t address) noexcept {
  uint8_t model = 0;
  return bus.read(kDefaultAddress, kModel, &model, 1) && model == kModelValue &&
         bus.write(kDefaultAddress, kAddress, address) && bus.write(address, kInterruptClear, 1) &&
         bus.write(address, kStart, kBackToBack);
}

Taken take(I2c& bus, uint8_t address, hal::RangeReading& out) noexcept {
  uint8_t ready = 0;
  if (!bus.read(address, kInterruptStatus, &ready, 1)) return Taken::failed;
  if ((ready & 0x07) == 0) return Taken::nothing_new;
  uint8_t bytes[kRangeBytes];
  if (!bus.read(address, kRangeStatus, bytes, kRangeBytes)) return Taken::failed;
  if (!bus.write(address, kInterruptClear, 1)) return Taken::failed;
  decode(bytes, out);
  return Taken::measured;
}

}  // namespace

const RangerKind kVl53l0x = {start, take, 2, 200, kRangingMs};

}  // namespace whisker::hal::stm32f405
