#include "hal/boards/pico/usb_control.hpp"

#include "hal/boards/pico/reg/bases.hpp"
#include "hal/boards/pico/reg/usb.hpp"
#include "hal/boards/pico/reg/usb_dpram.hpp"
#include "hal/boards/pico/usb_descriptors.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint16_t kRoom = 0x100;  // of endpoint 0: RP2040 data sheet, 4.1.2.5
constexpr uint16_t kEndpointHalt = 0;
constexpr uint16_t kTerminalReady = 1;
constexpr uint8_t kLongestAddress = 127;

/// bmRequestType in the upper half.
enum Request : uint16_t {
  kSetAddress = 0x0005,
  kSetConfiguration = 0x0009,
  kGetDeviceStatus = 0x8000,
  kGetDescriptor = 0x8006,
  kGetConfiguration = 0x8008,
  kSetInterface = 0x010B,
  kGetInterfaceStatus = 0x8100,
  kGetInterface = 0x810A,
  kClearHalt = 0x0201,
  kSetHalt = 0x0203,
  kGetEndpointStatus = 0x8200,
  kSetLineCoding = 0x2120,
  kSetLineState = 0x2122,
  kSendBreak = 0x2123,
  kGetLineCoding = 0xA121,
};

constexpr bool to_host(uint16_t what) noexcept { return (what & 0x8000U) != 0; }
constexpr uint8_t recipient(uint16_t what) noexcept { return what >> 8 & 0x1FU; }
constexpr uint8_t kToDevice = 0, kToInterface = 1, kToEndpoint = 2;

constexpr char kMakerText[] = "Whisker";
constexpr char kProductText[] = "Whisker robot";

}  // namespace

UsbControl::UsbControl(UsbData& data) noexcept
    : data_(data),
      in_(UsbPipe::Way::in, usb_dpram::kEp0InBufferControl, kRoom),
      out_(UsbPipe::Way::out, usb_dpram::kEp0OutBufferControl, kRoom) {}

void UsbControl::set_id(const uint8_t (&id)[kIdBytes]) noexcept {
  for (uint8_t i = 0; i < 2 * kIdBytes; ++i)
    id_[i] = "0123456789ABCDEF"[id[i / 2] >> (i % 2 == 0 ? 4 : 0) & 15];
}

void UsbControl::on_bus_reset() noexcept {
  store(base::kUsb, usb::kAddrEndp, 0);
  in_.reset(true);
  out_.reset(true);
  stage_ = Stage::idle;
  address_ = configuration_ = 0;
  terminal_ready_ = false;
  data_.end();
}

/// A request ends the one before, whose packet the controller may still have.
void UsbControl::on_setup() noexcept {
  in_.reset(true);
  out_.reset(true);
  stage_ = Stage::idle;
  address_ = 0;
  const uint32_t first = load(base::kUsbDpram, usb_dpram::kSetupPacketLow);
  const uint32_t second = load(base::kUsbDpram, usb_dpram::kSetupPacketHigh);
  const Setup setup{static_cast<uint16_t>(value(usb_dpram::kBmrequesttype, first) << 8 |
                                          value(usb_dpram::kBrequest, first)),
                    static_cast<uint16_t>(value(usb_dpram::kWvalue, first)),
                    static_cast<uint16_t>(value(usb_dpram::kWindex, second)),
                    static_cast<uint16_t>(value(usb_dpram::kWlength, second))};
  switch (answer(setup)) {
    case Answer::stall: return stall();
    case Answer::done: return finish();
    case Answer::wants_data: stage_ = Stage::data_out; return out_.arm();
    case Answer::data:
      short_ends_ = left_ < setup.length;
      if (left_ > setup.length) left_ = static_cast<uint8_t>(setup.length);
      if (setup.length == 0) return finish();
      stage_ = Stage::data_in;
      return send_data();
  }
}

UsbControl::Answer UsbControl::answer(const Setup& setup) noexcept {
  const bool carries = !to_host(setup.what) && setup.length != 0;
  if (carries != (setup.what == kSetLineCoding)) return Answer::stall;
  if (recipient(setup.what) == kToInterface) return answer_interface(setup);
  if (recipient(setup.what) == kToEndpoint) return answer_endpoint(setup);
  switch (setup.what) {
    case kGetDescriptor: return describe(setup);
    case kGetDeviceStatus: return say_word(0, 2);  // power from the bus, never wakes the host
    case kGetConfiguration: return say_word(configuration_, 1);
    case kSetAddress:
      if (setup.value > kLongestAddress) return Answer::stall;
      address_ = static_cast<uint8_t>(setup.value);
      return Answer::done;
    case kSetConfiguration:
      if (setup.value > usb::kConfiguration) return Answer::stall;
      configuration_ = static_cast<uint8_t>(setup.value);
      terminal_ready_ = false;
      if (configuration_ != 0) {
        data_.begin();
      } else {
        data_.end();
      }
      return Answer::done;
    default: return Answer::stall;
  }
}

UsbControl::Answer UsbControl::answer_interface(const Setup& setup) noexcept {
  if (configuration_ == 0 || setup.index >= usb::kInterfaces) return Answer::stall;
  switch (setup.what) {
    case kGetInterfaceStatus: return say_word(0, 2);
    case kGetInterface: return say_word(0, 1);
    case kSetInterface:
      if (setup.value != 0) return Answer::stall;
      if (setup.index == usb::kDataInterface) data_.begin();
      return Answer::done;
    default: break;
  }
  if (setup.index != usb::kControlInterface) return Answer::stall;
  switch (setup.what) {
    case kGetLineCoding: return say(coding_, kCodingBytes);
    case kSetLineCoding: return setup.length == kCodingBytes ? Answer::wants_data : Answer::stall;
    case kSetLineState: terminal_ready_ = (setup.value & kTerminalReady) != 0; return Answer::done;
    case kSendBreak: return Answer::done;
    default: return Answer::stall;
  }
}

UsbControl::Answer UsbControl::answer_endpoint(const Setup& setup) noexcept {
  const auto address = static_cast<uint8_t>(setup.index);
  const bool zero = setup.index == 0 || setup.index == 0x80;
  const UsbPipe* const pipe = configuration_ != 0 && setup.index <= UINT8_MAX ? data_.pipe(address) : nullptr;
  if (!zero && pipe == nullptr) return Answer::stall;
  if (setup.what == kGetEndpointStatus) return say_word(pipe != nullptr && pipe->halted() ? 1 : 0, 2);
  if (setup.value != kEndpointHalt) return Answer::stall;
  if (setup.what == kClearHalt) {
    if (!zero) data_.halt(address, false);
    return Answer::done;
  }
  return setup.what == kSetHalt && !zero && data_.halt(address, true) ? Answer::done : Answer::stall;
}

UsbControl::Answer UsbControl::describe(const Setup& setup) noexcept {
  const auto number = static_cast<uint8_t>(setup.value);
  switch (setup.value >> 8) {
    case usb::kDevice: return say(usb::kDeviceDescriptor, sizeof usb::kDeviceDescriptor);
    case usb::kConfigurations:
      if (number != 0) return Answer::stall;
      return say(usb::kConfigurationDescriptor, sizeof usb::kConfigurationDescriptor);
    case usb::kString: break;
    default: return Answer::stall;
  }
  switch (number) {
    case 0: return say_text("\x09\x04", 0);  // English, United States
    case usb::kMaker: return say_text(kMakerText, sizeof kMakerText - 1);
    case usb::kProduct: return say_text(kProductText, sizeof kProductText - 1);
    case usb::kSerial: return say_text(id_, sizeof id_);
    default: return Answer::stall;
  }
}

UsbControl::Answer UsbControl::say(const uint8_t* data, uint8_t size) noexcept {
  next_ = data;
  left_ = size;
  return Answer::data;
}

UsbControl::Answer UsbControl::say_word(uint8_t first, uint8_t size) noexcept {
  said_[0] = first;
  said_[1] = 0;
  return say(said_, size);
}

/// A string descriptor. size 0: the list of languages, whose only one is in the text.
UsbControl::Answer UsbControl::say_text(const char* text, uint8_t size) noexcept {
  const uint8_t bytes = static_cast<uint8_t>(size == 0 ? 4 : 2 + 2 * size);
  said_[0] = bytes;
  said_[1] = usb::kString;
  said_[2] = static_cast<uint8_t>(text[0]);
  said_[3] = size == 0 ? static_cast<uint8_t>(text[1]) : uint8_t{0};
  for (uint8_t i = 1; i < size; ++i) {
    said_[2 + 2 * i] = static_cast<uint8_t>(text[i]);
    said_[3 + 2 * i] = 0;
  }
  return say(said_, bytes);
}

void UsbControl::send_data() noexcept {
  const uint8_t size = left_ < UsbPipe::kPacket ? left_ : UsbPipe::kPacket;
  for (uint8_t i = 0; i < size; ++i) in_.put(i, next_[i]);
  next_ += size;
  left_ = static_cast<uint8_t>(left_ - size);
  if (size < UsbPipe::kPacket) short_ends_ = false;
  in_.arm(size);
}

void UsbControl::finish() noexcept {
  stage_ = Stage::status_in;
  in_.arm(0);
}

void UsbControl::stall() noexcept {
  store(base::kUsb, usb::kEpStallArm, mask(usb::kStallEp0In) | mask(usb::kStallEp0Out));
  in_.halt();
  out_.halt();
}

void UsbControl::on_sent() noexcept {
  if (stage_ == Stage::data_in) {
    // A full packet does not say that it is the last one.
    if (left_ != 0 || short_ends_) return send_data();
    stage_ = Stage::status_out;
    out_.reset(true);
    out_.arm();
  } else if (stage_ == Stage::status_in) {
    stage_ = Stage::idle;
    if (address_ == 0) return;
    store(base::kUsb, usb::kAddrEndp, address_);
    address_ = 0;
  }
}

void UsbControl::on_received() noexcept {
  if (stage_ != Stage::data_out) {
    stage_ = Stage::idle;
    return;
  }
  if (out_.size() != kCodingBytes) return stall();
  for (uint8_t i = 0; i < kCodingBytes; ++i) coding_[i] = out_.get(i);
  finish();
}

}  // namespace whisker::hal::pico
