#include "tests/boards/models/i2c_model.hpp"

namespace whisker::hal::stm32f405::model {

bool I2cModel::set_up_for_400khz(double mhz) {
  const double hz = mhz * 1e6 / (3.0 * get(i2c::kCcrValue));
  return get(i2c::kPe) != 0 && get(i2c::kFast) != 0 && get(i2c::kFreq) == mhz && hz <= 400001 &&
         hz > 350000 && word(i2c::kTrise.offset) == static_cast<std::uint32_t>(mhz * 0.3) + 1;
}

void I2cModel::reset() {
  phase_ = Phase::idle;
  device_ = nullptr;
  shifting_ = shift_full_ = data_full_ = false;
  word(i2c::kSr1.offset) = 0;
  word(i2c::kSr2.offset) = 0;
}

std::uint32_t I2cModel::load(std::uint32_t offset) {
  put(i2c::kBusy, line_held || phase_ != Phase::idle ? 1 : 0);
  const std::uint32_t result = word(offset);
  if (offset == i2c::kSr1.offset) status_read_ = true;
  if (offset == i2c::kSr2.offset && status_read_ && phase_ == Phase::address_flag) {
    put(i2c::kAddr, 0);
    phase_ = reading_ ? Phase::reading : Phase::writing;
    ack_next_ = get(i2c::kAck) != 0;
    shifting_ = reading_;
    left_ = 9 * kBit;
    put(i2c::kTxe, reading_ ? 0 : 1);
  }
  if (offset == i2c::kDr.offset) {
    put(i2c::kRxne, 0);
    put(i2c::kBtf, 0);
    data_full_ = false;
    if (shift_full_) {
      shift_full_ = false;
      data_full_ = true;
      word(i2c::kDr.offset) = shift_;
      put(i2c::kRxne, 1);
      if (phase_ == Phase::reading) {
        shifting_ = true;
        left_ = 9 * kBit;
      } else if (phase_ == Phase::halted && get(i2c::kStop) != 0) {
        stop();
      }
    }
  }
  return result;
}

void I2cModel::store(std::uint32_t offset, std::uint32_t value) {
  if (offset == i2c::kSr1.offset) {
    // Writing 0 clears error flags; the hardware owns the others.
    word(offset) &= value | ~(mask(i2c::kBerr) | mask(i2c::kArlo) | mask(i2c::kAf));
    return;
  }
  if (offset == i2c::kDr.offset) {
    if (get(i2c::kSb) != 0 && status_read_) {
      put(i2c::kSb, 0);
      phase_ = Phase::addressing;
      shift_ = static_cast<std::uint8_t>(value);
      left_ = 9 * kBit;
      shifting_ = true;
    } else if (phase_ == Phase::writing) {
      put(i2c::kBtf, 0);
      word(offset) = value;
      data_full_ = true;
      put(i2c::kTxe, 0);
      if (!shifting_) end_byte();
    }
    return;
  }
  word(offset) = value;
  if (offset != i2c::kCr1.offset) return;
  if (get(i2c::kSwrst) != 0) reset();
  if (get(i2c::kPe) == 0) return;
  if (get(i2c::kStart) != 0) begin_start();
  if (get(i2c::kStop) != 0 && !shifting_ && (phase_ != Phase::halted || !shift_full_)) stop();
}

void I2cModel::begin_start() {
  status_read_ = false;
  if (fault == Fault::deaf || line_held) return;
  phase_ = Phase::starting;
  left_ = kBit;
  shifting_ = true;
}

void I2cModel::stop() {
  put(i2c::kStop, 0);
  if (phase_ == Phase::idle) return;
  if (device_ != nullptr) device_->stop();
  device_ = nullptr;
  phase_ = Phase::idle;
  put(i2c::kTxe, 0);
  put(i2c::kBtf, 0);
  ++stops;
}

void I2cModel::advance() {
  if (!shifting_ || fault == Fault::clock_held || --left_ > 0) return;
  end_byte();
}

void I2cModel::end_byte() {
  switch (phase_) {
    case Phase::starting:
      shifting_ = shift_full_ = data_full_ = false;
      put(i2c::kTxe, 0);
      put(i2c::kBtf, 0);
      put(i2c::kStart, 0);
      put(i2c::kSb, 1);
      break;
    case Phase::addressing: end_address(); break;
    case Phase::writing: end_write(); break;
    case Phase::reading: end_read(); break;
    case Phase::idle:
    case Phase::address_flag:
    case Phase::halted: shifting_ = false; break;
  }
}

void I2cModel::end_address() {
  shifting_ = false;
  if (fault == Fault::arbitration) {
    put(i2c::kArlo, 1);
    phase_ = Phase::idle;
    return;
  }
  if (fault == Fault::bus_error) {
    put(i2c::kBerr, 1);
    phase_ = Phase::halted;
    return;
  }
  reading_ = (shift_ & 1U) != 0;
  device_ = nullptr;
  for (I2cDevice* d : devices_) {
    if (d->answers(static_cast<std::uint8_t>(shift_ >> 1))) device_ = d;
  }
  if (device_ == nullptr) {
    put(i2c::kAf, 1);
    phase_ = Phase::halted;
    return;
  }
  device_->begin(reading_);
  put(i2c::kAddr, 1);
  phase_ = Phase::address_flag;
}

void I2cModel::end_write() {
  if (shifting_) {
    shifting_ = false;
    if (!device_->write(shift_)) {
      put(i2c::kAf, 1);
      phase_ = Phase::halted;
      return;
    }
  }
  if (data_full_) {
    shift_ = static_cast<std::uint8_t>(word(i2c::kDr.offset));
    data_full_ = false;
    shifting_ = true;
    left_ = 9 * kBit;
    put(i2c::kTxe, 1);
  } else {
    put(i2c::kBtf, 1);
  }
}

void I2cModel::end_read() {
  shifting_ = false;
  // With POS, the acknowledgement applies to the next byte.
  const bool ack_now = get(i2c::kAck) != 0;
  const bool acked = get(i2c::kPos) != 0 ? ack_next_ : ack_now;
  ack_next_ = ack_now;
  shift_ = device_->read();
  if (!acked) phase_ = Phase::halted;
  if (acked && get(i2c::kStop) != 0) ++unwanted_bytes;
  if (data_full_) {
    shift_full_ = true;
    put(i2c::kBtf, 1);
  } else {
    word(i2c::kDr.offset) = shift_;
    data_full_ = true;
    put(i2c::kRxne, 1);
    shifting_ = acked;
    left_ = 9 * kBit;
  }
  if (get(i2c::kStop) != 0 && !shift_full_) stop();
}

}  // namespace whisker::hal::stm32f405::model
