#include "hal/boards/pico/usb_pipe.hpp"

#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/usb_dpram.hpp"

namespace whisker::hal::pico {

using namespace usb_dpram;

void UsbPipe::reset(bool data1) noexcept {
  data1_ = data1;
  halted_ = false;
  store(base::kUsbDpram, control_, 0);
}

void UsbPipe::arm(uint8_t size) noexcept {
  const uint32_t word =
      bits(kLength, size) | bits(kPid, data1_ ? 1 : 0) | bits(kFull, way_ == Way::in ? 1 : 0);
  data1_ = !data1_;
  store(base::kUsbDpram, control_, word);
  // The controller has another clock, and must see the rest before it sees that it may go: three periods of
  // 48 MHz.
  asm volatile("nop\n nop\n nop\n nop\n nop\n nop\n nop\n nop" ::: "memory");
  store(base::kUsbDpram, control_, word | mask(kAvailable));
}

void UsbPipe::halt() noexcept {
  halted_ = true;
  store(base::kUsbDpram, control_, mask(kStall));
}

uint8_t UsbPipe::size() const noexcept {
  const uint32_t size = value(kLength, load(base::kUsbDpram, control_));
  return static_cast<uint8_t>(size < kPacket ? size : kPacket);
}

volatile uint8_t* UsbPipe::room() const noexcept {
  return reinterpret_cast<volatile uint8_t*>(base::kUsbDpram + room_);
}

}  // namespace whisker::hal::pico
