#include "hal/boards/pico/usb_line.hpp"

#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/reg/usb.hpp"
#include "hal/boards/pico/reg/usb_dpram.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kEvents = mask(usb::kOnBuffStatus) | mask(usb::kOnBusReset) | mask(usb::kOnDevSuspend) |
                             mask(usb::kOnDevResume) | mask(usb::kOnSetupReq);
constexpr uint32_t kBulk = 2, kInterrupt = 3;
constexpr uint16_t kControls = 0x100;  // bytes of the shared memory that are no room for packets

/// The handler does not run while this lives; what happens meanwhile is not lost.
class Quiet {
 public:
  Quiet() noexcept { store(base::kUsb, usb::kInte, 0); }
  ~Quiet() { store(base::kUsb, usb::kInte, kEvents); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

void set_up(Register control, uint32_t kind, uint32_t room) noexcept {
  store(base::kUsbDpram, control,
        mask(usb_dpram::kEnable) | mask(usb_dpram::kInterruptPerBuff) | bits(usb_dpram::kEndpointType, kind) |
            room);
}

}  // namespace

void UsbLine::start(const uint8_t (&id)[UsbControl::kIdBytes]) noexcept {
  control_.set_id(id);
  for (uint16_t at = 0; at < kControls; at = static_cast<uint16_t>(at + 4)) store(base::kUsbDpram + at, 0);
  set_up(usb_dpram::kEp1InControl, kInterrupt, UsbData::kNoticesRoom);
  set_up(usb_dpram::kEp2InControl, kBulk, UsbData::kInRoom);
  set_up(usb_dpram::kEp2OutControl, kBulk, UsbData::kOutRoom);
  store(base::kUsb, usb::kUsbMuxing, mask(usb::kToPhy) | mask(usb::kSoftcon));
  // The Pico does not lead the cable's 5 V to the controller.
  store(base::kUsb, usb::kUsbPwr, mask(usb::kVbusDetect) | mask(usb::kVbusDetectOverrideEn));
  store(base::kUsb, usb::kMainCtrl, mask(usb::kControllerEn));
  store(base::kUsb, usb::kInte, kEvents);
  enable(Interrupt::usb);
  store(base::kUsb, usb::kSieCtrl, mask(usb::kEp0Int1buf) | mask(usb::kPullupEn));
}

bool UsbLine::ready() noexcept {
  const bool parted = parted_;
  if (open() && !parted) return true;
  if (!parted && !data_.has_come()) return false;
  const Quiet quiet;
  parted_ = false;
  data_.discard();
  return false;
}

size_t UsbLine::take(uint8_t* to, size_t room) noexcept {
  if (!data_.has_come()) return 0;
  const Quiet quiet;
  return data_.take(to, room);
}

size_t UsbLine::offer(const uint8_t* from, size_t count) noexcept {
  const size_t put = data_.put(from, count);
  if (put != count) refused_.happened();
  const Quiet quiet;
  data_.go_on();
  return put;
}

void UsbLine::on_interrupt() noexcept {
  const bool was_open = open();
  const uint32_t why = load(base::kUsb, usb::kInts);
  if ((why & mask(usb::kOnBusReset)) != 0) {
    store(base::kUsb, usb::kSieStatus, mask(usb::kBusReset));
    suspended_ = false;
    control_.on_bus_reset();
  }
  if ((why & mask(usb::kOnDevSuspend)) != 0) {
    store(base::kUsb, usb::kSieStatus, mask(usb::kSuspended));
    suspended_ = true;
  }
  if ((why & mask(usb::kOnDevResume)) != 0) {
    store(base::kUsb, usb::kSieStatus, mask(usb::kResume));
    suspended_ = false;
  }
  // Packets have passed before the request that is there now.
  if ((why & mask(usb::kOnBuffStatus)) != 0) {
    const uint32_t passed = load(base::kUsb, usb::kBuffStatus);
    store(base::kUsb, usb::kBuffStatus, passed);
    if ((passed & mask(usb::kEp0In)) != 0) control_.on_sent();
    if ((passed & mask(usb::kEp0Out)) != 0) control_.on_received();
    if ((passed & mask(usb::kEp2In)) != 0) data_.on_sent();
    if ((passed & mask(usb::kEp2Out)) != 0) data_.on_received();
  }
  if ((why & mask(usb::kOnSetupReq)) != 0) {
    store(base::kUsb, usb::kSieStatus, mask(usb::kSetupRec));
    control_.on_setup();
  }
  if (was_open && !open()) parted_ = true;
}

}  // namespace whisker::hal::pico
