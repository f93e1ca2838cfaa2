#include "hal/boards/pico/robot_board.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/image.hpp"
#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/pins.hpp"
#include "hal/boards/pico/reg/rosc.hpp"

namespace whisker::hal::pico {
namespace {

constexpr int kBootBits = 16;
constexpr uint32_t kBetweenBitsUs = 10;
/// Without the crystal, the core runs from the ring oscillator: about 6 MHz.
constexpr uint32_t kSlowHz = 6000000;

RobotBoard* interrupted = nullptr;

void spend(uint32_t us, uint32_t core_hz) noexcept {
  for (Patience patience = Patience::for_us(us, core_hz); patience.spend();) load(base::kSio, sio::kGpioIn);
}

}  // namespace

bool RobotBoard::start() noexcept {
  wake_peripherals();
  set_up_pins();
  if (!start_clocks()) {
    troubles_.count(Trouble::crystal_not_ready);
    return false;
  }
  if (!image_is_intact()) {
    troubles_.count(Trouble::image_damaged);
    return false;
  }
  interrupted = this;
  ticker_.start();
  line_.start();
  start_usb();
  encoders_.start();
  sensors_.start(ticker_.now_ms());
  return true;
}

void RobotBoard::start_usb() noexcept {
  if (!start_usb_clock()) {
    troubles_.count(Trouble::usb_no_clock);
    return;
  }
  uint8_t id[FlashStorage::kIdBytes];
  FlashStorage::read_id(id);
  usb_.start(id);
}

void RobotBoard::refuse() noexcept {
  for (uint32_t ms = 0;; ms += Led::kSixteenthMs) {
    led_.show(Led::kFast, ms);
    spend(Led::kSixteenthMs * 1000, kSlowHz);
  }
}

void RobotBoard::adopt(const Params& params) noexcept {
  wheels_.adopt(motor_of(params), motor_of(params));
  const bool sonar = params.rangefinders.sonar == Fitted::yes;
  const Uninterrupted uninterrupted;
  sensors_.adopt(params.gyro, !sonar);
  echoes_.adopt(sonar);
  fitted_.choose(sonar ? echoes_.sonars() : sensors_.rangers());
}

void RobotBoard::watch() noexcept {
  watchdog_.start(kWatchdogMs);
  for (FlashStorage& storage : storage_) storage.start(kWatchdogMs);
  motors_.start();
  schedule_.begin(ticker_.now_ms());
}

void RobotBoard::poll() noexcept {
  const uint32_t now = ticker_.now_ms();
  bumper_.poll(now);
  button_.poll(now);
  echoes_.poll();
  sensors_.collect(troubles_);
  encoders_.collect(troubles_);
  troubles_.count(Trouble::line_bytes_lost, line_.collect_lost());
  troubles_.count(Trouble::usb_not_read, usb_.collect_refused());
}

bool RobotBoard::due(uint32_t period_ms) noexcept {
  if (!schedule_.due(ticker_.now_ms(), period_ms)) return false;
  watchdog_.feed();
  return true;
}

void RobotBoard::mark_tick(bool runs) noexcept { write(wiring::kTick, runs); }

uint16_t RobotBoard::boot_number() noexcept {
  uint16_t number = 0;
  for (int i = 0; i < kBootBits; ++i) {
    number = static_cast<uint16_t>(number << 1 | (load(base::kRosc, rosc::kRandombit) & 1U));
    spend(kBetweenBitsUs, kCoreHz);
  }
  return number;
}

void RobotBoard::on_millisecond() noexcept {
  ticker_.on_interrupt();
  sensors_.on_millisecond();
}

}  // namespace whisker::hal::pico

extern "C" {

void millisecond_interrupt() noexcept;
void usb_interrupt() noexcept;
void line_interrupt() noexcept;
void bus_interrupt() noexcept;
void edge_interrupt() noexcept;

void millisecond_interrupt() noexcept { whisker::hal::pico::interrupted->on_millisecond(); }
void usb_interrupt() noexcept { whisker::hal::pico::interrupted->on_usb_interrupt(); }
void line_interrupt() noexcept { whisker::hal::pico::interrupted->on_line_interrupt(); }
void bus_interrupt() noexcept { whisker::hal::pico::interrupted->on_bus_interrupt(); }
void edge_interrupt() noexcept { whisker::hal::pico::interrupted->on_edge_interrupt(); }
}
