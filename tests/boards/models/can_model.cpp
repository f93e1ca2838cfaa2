#include "tests/boards/models/can_model.hpp"

#include <algorithm>

namespace whisker::hal::stm32f405::model {
namespace {

std::uint32_t word_at(const std::uint8_t* b) {
  return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

}  // namespace

CanModel::CanModel() {
  put(can::kSleep, 1);
  put(can::kFinit, 1);
  for (const Field empty : can::kTme) put(empty, 1);
}

double CanModel::bitrate(double clock_hz) {
  return clock_hz / ((get(can::kBrp) + 1) * (3.0 + get(can::kTs1) + get(can::kTs2)));
}

double CanModel::sample_point() { return (2.0 + get(can::kTs1)) / (3.0 + get(can::kTs1) + get(can::kTs2)); }

std::uint32_t CanModel::load(std::uint32_t offset) {
  if (dead) return 0;
  if (offset == can::kRf0r.offset) put(can::kFmp0, static_cast<std::uint32_t>(fifo_.size()));
  if (fifo_.empty()) return word(offset);
  const hal::CanFrame& f = fifo_.front();
  if (offset == can::kRxId.offset) {
    return (f.extended ? f.id << 3 | mask(can::kIde) : bits(can::kStid, f.id)) | bits(can::kRtr, f.remote);
  }
  if (offset == can::kDlc.offset) return f.size;
  if (offset == can::kRxLow.offset) return word_at(f.data);
  if (offset == can::kRxHigh.offset) return word_at(f.data + 4);
  return word(offset);
}

void CanModel::store(std::uint32_t offset, std::uint32_t value) {
  if (dead) return;
  if (offset == can::kTsr.offset) {
    for (std::uint8_t box = 0; box < can::kMailboxes; ++box) {
      if ((value & mask(can::kRqcp[box])) != 0) {
        for (const Field f : {can::kRqcp[box], can::kTxok[box], can::kAlst[box], can::kTerr[box]}) put(f, 0);
      }
      if ((value & mask(can::kAbrq[box])) != 0 && get(can::kTme[box]) == 0) complete(box, false);
    }
    return;
  }
  if (offset == can::kRf0r.offset) {
    if ((value & mask(can::kRfom0)) != 0 && !fifo_.empty()) fifo_.pop_front();
    if ((value & mask(can::kFovr0)) != 0) put(can::kFovr0, 0);
    return;
  }
  // The bit timing is writable only during initialisation, a filter's set-up only while filters are off.
  if (offset == can::kBtr.offset && !in_init()) return;
  if ((offset == can::kFbm0.offset || offset == can::kFsc0.offset) && get(can::kFinit) == 0) return;
  word(offset) = value;
  for (std::uint8_t box = 0; box < can::kMailboxes; ++box) {
    if (offset != can::kTxId[box].offset || (value & mask(can::kTxrq)) == 0) continue;
    for (const Field f : {can::kTme[box], can::kRqcp[box], can::kTxok[box], can::kAlst[box], can::kTerr[box]})
      put(f, 0);
    left_[box] = kFrame;
    order_.push_back(box);
  }
}

void CanModel::complete(std::uint8_t box, bool ok) {
  put(can::kRqcp[box], 1);
  put(can::kTme[box], 1);
  put(can::kTxok[box], ok ? 1 : 0);
  order_.erase(std::remove(order_.begin(), order_.end(), box), order_.end());
  word(can::kTxId[box].offset) &= ~mask(can::kTxrq);
  if (!ok) return;
  const std::uint32_t id = word(can::kTxId[box].offset);
  hal::CanFrame f{};
  f.extended = (id & mask(can::kIde)) != 0;
  f.remote = (id & mask(can::kRtr)) != 0;
  f.id = f.extended ? id >> 3 : value(can::kStid, id);
  f.size = static_cast<std::uint8_t>(word(can::kTxSize[box].offset) & 0xF);
  for (int i = 0; i < 4; ++i) {
    f.data[i] = static_cast<std::uint8_t>(word(can::kTxLow[box].offset) >> (8 * i));
    f.data[4 + i] = static_cast<std::uint8_t>(word(can::kTxHigh[box].offset) >> (8 * i));
  }
  sent.push_back(f);
}

void CanModel::advance() {
  if (dead) return;
  if (get(can::kSleep) == 0 && get(can::kInrq) != 0) {
    put(can::kInak, 1);
    put(can::kBoff, 0);
    put(can::kEpvf, 0);
    joining_ = 2000;
  } else if (get(can::kInak) != 0 && get(can::kSleep) == 0 && bus != Bus::held && --joining_ <= 0) {
    put(can::kInak, 0);
  }
  if (in_init() || get(can::kBoff) != 0 || bus == Bus::held || order_.empty()) return;
  // With TXFP in request order, otherwise by identifier.
  const std::uint8_t box =
      get(can::kTxfp) != 0
          ? order_.front()
          : *std::min_element(order_.begin(), order_.end(), [this](std::uint8_t a, std::uint8_t b) {
              return word(can::kTxId[a].offset) < word(can::kTxId[b].offset);
            });
  if (--left_[box] > 0) return;
  if (bus == Bus::fine) {
    complete(box, true);
  } else {
    put(can::kAlst[box], bus == Bus::others_win ? 1 : 0);
    put(can::kTerr[box], bus == Bus::nobody_hears ? 1 : 0);
    left_[box] = kFrame;
  }
}

bool CanModel::receive(const hal::CanFrame& frame) {
  const bool listens = !dead && !in_init() && get(can::kBoff) == 0 && get(can::kFinit) == 0 &&
                       get(can::kFact0) != 0 && get(can::kFsc0) != 0 && get(can::kFbm0) == 0 &&
                       get(can::kFfa0) == 0 && word(can::kF0r2.offset) == 0;
  if (!listens) return false;
  if (fifo_.size() == 3) {
    put(can::kFovr0, 1);
    fifo_.back() = frame;
  } else {
    fifo_.push_back(frame);
  }
  return get(can::kFmpie0) != 0;
}

void CanModel::go_bus_off() {
  put(can::kBoff, 1);
  put(can::kEpvf, 1);
}

}  // namespace whisker::hal::stm32f405::model
