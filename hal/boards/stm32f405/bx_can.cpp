#include "hal/boards/stm32f405/bx_can.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/can.hpp"

namespace whisker::hal::stm32f405 {
namespace {

using hal::CanFrame;
using hal::CanState;

constexpr Address kBase = base::kCan1;
constexpr uint8_t kBytes = 8;

uint32_t word_of(const uint8_t* bytes) noexcept {
  return bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
}

void bytes_of(uint32_t word, uint8_t* bytes) noexcept {
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<uint8_t>(word >> (8 * i));
}

struct Timing {
  uint32_t prescaler;
  uint32_t quanta;
};

Timing timing_for(uint32_t bitrate, uint32_t hz) noexcept {
  const uint32_t quanta = hz % (bitrate * BxCan::kQuantaPerBit) == 0 ? BxCan::kQuantaPerBit : 16;
  return {hz / (bitrate * quanta), quanta};
}

/// A bit consists of one quantum, the quanta before the sample point, and two quanta after it.
uint32_t bit_timing(const Timing& t) noexcept {
  constexpr uint32_t kAfterSample = 2;
  return bits(can::kBrp, t.prescaler - 1) | bits(can::kTs1, t.quanta - 1 - kAfterSample - 1) |
         bits(can::kTs2, kAfterSample - 1) | bits(can::kSjw, 0);
}

void accept_everything() noexcept {
  set(kBase, can::kFinit, 1);
  set(kBase, can::kFact0, 0);
  set(kBase, can::kFsc0, 1);
  set(kBase, can::kFbm0, 0);
  store(kBase, can::kF0r1, 0);
  store(kBase, can::kF0r2, 0);
  set(kBase, can::kFfa0, 0);
  set(kBase, can::kFact0, 1);
  set(kBase, can::kFinit, 0);
}

}  // namespace

void BxCan::start(uint32_t bitrate, const Clocks& clocks) noexcept {
  bitrate_ = bitrate;
  clocks_ = clocks;
  restart();
}

bool BxCan::initialise(uint32_t apb1_hz) noexcept {
  set(kBase, can::kSleep, 0);
  set(kBase, can::kInrq, 1);
  if (!Patience::for_us(kHearUs, clocks_.core_hz).until(kBase, can::kInak, true)) return false;
  store(kBase, can::kBtr, bit_timing(timing_for(bitrate_, apb1_hz)));
  set(kBase, can::kTxfp, 1);
  accept_everything();
  set(kBase, can::kFmpie0, 1);
  set(kBase, can::kInrq, 0);
  return true;
}

void BxCan::restart() noexcept {
  drop_all();
  join_timed_ = false;
  if (initialise(clocks_.apb1_hz)) {
    state_ = CanState::starting;
    return;
  }
  count(counts_.not_started);
  state_ = CanState::off;
}

void BxCan::see_state() noexcept {
  switch (state_) {
    case CanState::off:
    case CanState::bus_off: return;
    case CanState::starting:
      if (!join_timed_) {
        join_timed_ = true;
        started_ms_ = now_ms_;
      }
      if (!is_set(kBase, can::kInak)) {
        state_ = CanState::active;
      } else if (now_ms_ - started_ms_ > kJoinMs) {
        count(counts_.not_started);
        state_ = CanState::off;
      }
      return;
    case CanState::active:
    case CanState::passive: break;
  }
  if (is_set(kBase, can::kBoff)) {
    count(counts_.bus_offs);
    drop_all();
    state_ = CanState::bus_off;
  } else {
    state_ = is_set(kBase, can::kEpvf) ? CanState::passive : CanState::active;
  }
}

bool BxCan::send(const CanFrame& frame, uint8_t lifetime_ms) noexcept {
  return outbox_.put(frame, lifetime_ms, on_bus(), counts_);
}

void BxCan::load_mailbox(uint8_t box, const CanFrame& frame) noexcept {
  const uint32_t id = frame.extended ? bits(can::kStid, frame.id >> can::kExid.width) |
                                           bits(can::kExid, frame.id) | bits(can::kIde, 1)
                                     : bits(can::kStid, frame.id);
  store(kBase, can::kTxSize[box], bits(can::kDlc, frame.size));
  store(kBase, can::kTxLow[box], word_of(frame.data));
  store(kBase, can::kTxHigh[box], word_of(frame.data + 4));
  store(kBase, can::kTxId[box], id | bits(can::kRtr, frame.remote ? 1 : 0) | bits(can::kTxrq, 1));
}

void BxCan::fill() noexcept {
  const uint32_t status = load(kBase, can::kTsr);
  for (uint8_t box = 0; box < can::kMailboxes; ++box) {
    const hal::CanOutbox::Waiting* next = outbox_.first();
    if (next == nullptr) return;
    if (mailbox_[box].busy || value(can::kTme[box], status) == 0) continue;
    mailbox_[box] = {true, false, next->until_ms};
    load_mailbox(box, next->frame);
    outbox_.pop();
  }
}

/// Reads the results of the frames in the mailboxes.
void BxCan::collect() noexcept {
  const uint32_t status = load(kBase, can::kTsr);
  for (uint8_t box = 0; box < can::kMailboxes; ++box) {
    if (!mailbox_[box].busy || value(can::kRqcp[box], status) == 0) continue;
    if (value(can::kTxok[box], status) != 0) {
      count(counts_.sent);
    } else {
      count(counts_.expired);
      if (value(can::kAlst[box], status) != 0) count(counts_.outbid);
      if (value(can::kTerr[box], status) != 0) count(counts_.unheard);
    }
    mailbox_[box].busy = false;
    // Only this bit: writing 1 clears it and its three neighbours, and zeros request no abort.
    store(kBase, can::kTsr, mask(can::kRqcp[box]));
  }
}

/// Drops stale frames in the mailboxes; the queue drops its own.
void BxCan::drop_stale() noexcept {
  for (uint8_t box = 0; box < can::kMailboxes; ++box) {
    Mailbox& mailbox = mailbox_[box];
    if (!mailbox.busy || mailbox.given_up || !reached(now_ms_, mailbox.until_ms)) continue;
    mailbox.given_up = true;
    store(kBase, can::kTsr, mask(can::kAbrq[box]));
  }
}

void BxCan::drop_all() noexcept {
  outbox_.drop_all(counts_);
  for (uint8_t box = 0; box < can::kMailboxes; ++box) {
    if (!mailbox_[box].busy) continue;
    count(counts_.expired);
    mailbox_[box].busy = false;
    store(kBase, can::kTsr, mask(can::kAbrq[box]));
  }
}

void BxCan::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  count(counts_.overrun, overruns_.collect());
  see_state();
  outbox_.expire(now_ms, counts_);
  if (!on_bus()) return;
  collect();
  drop_stale();
  fill();
}

bool BxCan::receive(CanFrame& out) noexcept {
  if (!received_.pop(out)) return false;
  count(counts_.received);
  return true;
}

void BxCan::on_receive_interrupt() noexcept {
  if (is_set(kBase, can::kFovr0)) {
    store(kBase, can::kRf0r, mask(can::kFovr0));
    overruns_.happened();
  }
  // The FIFO holds three frames; later ones raise the interrupt again.
  for (uint8_t left = 3; left > 0 && is_set(kBase, can::kFmp0); --left) {
    const uint32_t id = load(kBase, can::kRxId);
    CanFrame frame{};
    frame.extended = value(can::kIde, id) != 0;
    frame.remote = value(can::kRtr, id) != 0;
    frame.id = value(can::kStid, id);
    if (frame.extended) frame.id = frame.id << can::kExid.width | value(can::kExid, id);
    const uint8_t size = static_cast<uint8_t>(get(kBase, can::kDlc));
    frame.size = size > kBytes ? kBytes : size;
    bytes_of(load(kBase, can::kRxLow), frame.data);
    bytes_of(load(kBase, can::kRxHigh), frame.data + 4);
    store(kBase, can::kRf0r, mask(can::kRfom0));
    if (!received_.push(frame)) overruns_.happened();
  }
}

}  // namespace whisker::hal::stm32f405
