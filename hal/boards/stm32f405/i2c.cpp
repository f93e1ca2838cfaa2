#include "hal/boards/stm32f405/i2c.hpp"

#include "hal/boards/stm32f405/pins.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/i2c.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint32_t kBusHz = 400000;
constexpr uint32_t kClocksPerBit = 3;  // fast mode: low for two thirds of a bit
constexpr uint32_t kRiseNs = 300;
constexpr uint32_t kBusyUs = 50;  // a stop condition takes a few bits
constexpr int kFreeingClocks = 9;
constexpr uint32_t kHalfClockUs = 5;

constexpr Address kBase = base::kI2c1;

void order(Field bit) noexcept { set(kBase, bit, 1); }

void pause(Patience patience) noexcept {
  // The loads take the time.
  while (patience.spend()) load(kBase, i2c::kSr1);
}

/// After the address, the transfer continues only when the second status is read after the first.
void clear_address_flag() noexcept {
  load(kBase, i2c::kSr1);
  load(kBase, i2c::kSr2);
}

}  // namespace

void I2c::start(const Clocks& clocks, Troubles& troubles) noexcept {
  clocks_ = clocks;
  troubles_ = &troubles;
  configure();
}

void I2c::configure() noexcept {
  store(kBase, i2c::kCr1, mask(i2c::kSwrst));
  store(kBase, i2c::kCr1, 0);
  const uint32_t mhz = clocks_.apb1_hz / 1000000;
  set(kBase, i2c::kFreq, mhz);
  store(kBase, i2c::kCcr,
        bits(i2c::kFast, 1) |
            bits(i2c::kCcrValue, (clocks_.apb1_hz + kBusHz * kClocksPerBit - 1) / (kBusHz * kClocksPerBit)));
  store(kBase, i2c::kTrise, mhz * kRiseNs / 1000 + 1);
  store(kBase, i2c::kCr1, mask(i2c::kPe));
}

/// A sensor that was reset within a byte holds the data line until it gets the rest of the byte's clocks.
void I2c::free_bus() noexcept {
  using namespace wiring;
  make_open_drain(kI2cClock, true);
  make_open_drain(kI2cData, true);
  for (int i = 0; i < kFreeingClocks && !stm32f405::read(kI2cData); ++i) {
    stm32f405::write(kI2cClock, false);
    pause(patience(kHalfClockUs));
    stm32f405::write(kI2cClock, true);
    pause(patience(kHalfClockUs));
  }
  // A stop condition: data rises while the clock is high.
  stm32f405::write(kI2cClock, false);
  stm32f405::write(kI2cData, false);
  pause(patience(kHalfClockUs));
  stm32f405::write(kI2cClock, true);
  pause(patience(kHalfClockUs));
  stm32f405::write(kI2cData, true);
  pause(patience(kHalfClockUs));
  make_shared_line(kI2cClock, Function::i2c);
  make_shared_line(kI2cData, Function::i2c);
  configure();
}

bool I2c::take_bus() noexcept {
  if (patience(kBusyUs).until(kBase, i2c::kBusy, false)) return true;
  troubles_->count(Trouble::i2c_bus_stuck);
  free_bus();
  return patience(kBusyUs).until(kBase, i2c::kBusy, false);
}

I2c::Step I2c::wait(Field event, Patience& patience) noexcept {
  constexpr uint32_t kErrors = mask(i2c::kBerr) | mask(i2c::kArlo) | mask(i2c::kAf);
  for (;;) {
    const uint32_t status = load(kBase, i2c::kSr1);
    if ((status & kErrors) != 0) {
      if ((status & mask(i2c::kAf)) != 0) troubles_->count(Trouble::i2c_nack);
      if ((status & mask(i2c::kArlo)) != 0) troubles_->count(Trouble::i2c_arbitration_lost);
      if ((status & mask(i2c::kBerr)) != 0) troubles_->count(Trouble::i2c_bus_error);
      return Step::failed;
    }
    if ((status & mask(event)) != 0) return Step::done;
    if (!patience.spend()) return Step::timed_out;
  }
}

I2c::Step I2c::address(uint8_t byte, Patience& patience) noexcept {
  order(i2c::kStart);
  const Step started = wait(i2c::kSb, patience);
  if (started != Step::done) return started;
  store(kBase, i2c::kDr, byte);
  return wait(i2c::kAddr, patience);
}

I2c::Step I2c::send(uint8_t address_byte, const uint8_t* out, uint8_t size, Patience& patience) noexcept {
  Step step = address(address_byte, patience);
  if (step != Step::done) return step;
  clear_address_flag();
  for (uint8_t i = 0; i < size; ++i) {
    step = wait(i2c::kTxe, patience);
    if (step != Step::done) return step;
    store(kBase, i2c::kDr, out[i]);
  }
  // Waits until the last byte has left, to see its refusal and not to cut it off with a new start.
  return size == 0 ? Step::done : wait(i2c::kBtf, patience);
}

/// The last byte must be refused and the stop requested while the hardware still holds the clock. It holds
/// the clock when two bytes wait to be read, so the end is prepared at those points.
I2c::Step I2c::receive(uint8_t address_byte, uint8_t* in, uint8_t size, Patience& patience) noexcept {
  set(kBase, i2c::kAck, size > 1 ? 1 : 0);
  set(kBase, i2c::kPos, size == 2 ? 1 : 0);
  Step step = address(address_byte, patience);
  if (step != Step::done) return step;
  if (size == 1) {
    set(kBase, i2c::kAck, 0);
    clear_address_flag();
    order(i2c::kStop);
    step = wait(i2c::kRxne, patience);
    if (step == Step::done) in[0] = static_cast<uint8_t>(load(kBase, i2c::kDr));
    return step;
  }
  clear_address_flag();
  if (size == 2) set(kBase, i2c::kAck, 0);
  uint8_t i = 0;
  for (; i + 3 < size; ++i) {
    step = wait(i2c::kRxne, patience);
    if (step != Step::done) return step;
    in[i] = static_cast<uint8_t>(load(kBase, i2c::kDr));
  }
  step = wait(i2c::kBtf, patience);
  if (step != Step::done) return step;
  if (size > 2) {
    set(kBase, i2c::kAck, 0);
    in[i++] = static_cast<uint8_t>(load(kBase, i2c::kDr));
    step = wait(i2c::kBtf, patience);
    if (step != Step::done) return step;
  }
  order(i2c::kStop);
  in[i++] = static_cast<uint8_t>(load(kBase, i2c::kDr));
  step = wait(i2c::kRxne, patience);
  if (step == Step::done) in[i] = static_cast<uint8_t>(load(kBase, i2c::kDr));
  return step;
}

bool I2c::finish(Step step) noexcept {
  switch (step) {
    case Step::done: return true;
    case Step::failed: order(i2c::kStop); break;
    case Step::timed_out:
      troubles_->count(Trouble::i2c_timeout);
      free_bus();
      return false;
  }
  // Writing 0 clears error flags.
  store(kBase, i2c::kSr1, 0);
  if (!patience(kBusyUs).until(kBase, i2c::kBusy, false)) free_bus();
  return false;
}

bool I2c::transfer(uint8_t address, const uint8_t* out, uint8_t out_size, uint8_t* in,
                   uint8_t in_size) noexcept {
  if (!take_bus()) return false;
  Patience left = patience(kTransferUs);
  const uint8_t to_write = static_cast<uint8_t>(address << 1);
  if (out_size > 0 || in_size == 0) {
    const Step sent = send(to_write, out, out_size, left);
    if (sent != Step::done) return finish(sent);
    if (in_size == 0) order(i2c::kStop);
  }
  if (in_size == 0) return true;
  return finish(receive(static_cast<uint8_t>(to_write | 1), in, in_size, left));
}

bool I2c::write(uint8_t address, uint8_t reg, uint8_t byte) noexcept {
  const uint8_t out[] = {reg, byte};
  return transfer(address, out, sizeof out, nullptr, 0);
}

bool I2c::read(uint8_t address, uint8_t reg, uint8_t* in, uint8_t in_size) noexcept {
  return transfer(address, &reg, 1, in, in_size);
}

}  // namespace whisker::hal::stm32f405
