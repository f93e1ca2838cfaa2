#include "hal/boards/pico/usb_data.hpp"

#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/usb_dpram.hpp"
#include "hal/boards/pico/usb_descriptors.hpp"

namespace whisker::hal::pico {

UsbData::UsbData() noexcept
    : notices_(UsbPipe::Way::in, usb_dpram::kEp1InBufferControl, kNoticesRoom),
      in_(UsbPipe::Way::in, usb_dpram::kEp2InBufferControl, kInRoom),
      out_(UsbPipe::Way::out, usb_dpram::kEp2OutBufferControl, kOutRoom) {}

void UsbData::begin() noexcept {
  end();
  on_ = true;
  out_.arm();
}

void UsbData::end() noexcept {
  on_ = busy_ = open_ended_ = false;
  notices_.reset(false);
  in_.reset(false);
  out_.reset(false);
  queue_.drop(queue_.size());
  packet_ = left_ = 0;
}

const UsbPipe* UsbData::pipe(uint8_t address) const noexcept {
  switch (address) {
    case usb::kNotices: return &notices_;
    case usb::kToHost: return &in_;
    case usb::kFromHost: return &out_;
    default: return nullptr;
  }
}

bool UsbData::halt(uint8_t address, bool halted) noexcept {
  const UsbPipe* const known = pipe(address);
  if (known == nullptr) return false;
  UsbPipe& pipe = known == &in_ ? in_ : known == &out_ ? out_ : notices_;
  if (halted) {
    pipe.halt();
    return true;
  }
  pipe.reset(false);
  if (&pipe == &in_) {
    // What the host has not got comes again.
    busy_ = false;
    go_on();
  } else if (&pipe == &out_) {
    listen();
  }
  return true;
}

void UsbData::listen() noexcept {
  if (on_ && left_ == 0 && !out_.halted()) out_.arm();
}

void UsbData::on_sent() noexcept {
  if (!busy_) return;
  busy_ = false;
  queue_.drop(packet_);
  packet_ = 0;
  go_on();
}

void UsbData::on_received() noexcept {
  at_ = 0;
  left_ = out_.size();
  listen();
}

void UsbData::discard() noexcept {
  queue_.drop(queue_.size());
  packet_ = 0;
  open_ended_ = false;
  if (left_ == 0) return;
  left_ = 0;
  listen();
}

size_t UsbData::put(const uint8_t* from, size_t count) noexcept {
  size_t put = 0;
  while (put < count && queue_.push(from[put])) ++put;
  return put;
}

void UsbData::go_on() noexcept {
  if (!on_ || busy_ || in_.halted()) return;
  const uint16_t waiting = queue_.size();
  if (waiting == 0 && !open_ended_) return;
  packet_ = static_cast<uint8_t>(waiting < UsbPipe::kPacket ? waiting : UsbPipe::kPacket);
  for (uint8_t i = 0; i < packet_; ++i) in_.put(i, queue_.at(i));
  open_ended_ = packet_ == UsbPipe::kPacket;
  busy_ = true;
  in_.arm(packet_);
}

size_t UsbData::take(uint8_t* to, size_t room) noexcept {
  size_t taken = 0;
  for (; taken < room && left_ != 0; ++taken) {
    to[taken] = out_.get(at_++);
    left_ = static_cast<uint8_t>(left_ - 1);
  }
  if (taken != 0) listen();
  return taken;
}

}  // namespace whisker::hal::pico
