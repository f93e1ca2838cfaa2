#pragma once

#include "hal/boards/common/schedule.hpp"
#include "hal/boards/stm32f405/bx_can.hpp"
#include "hal/boards/stm32f405/reporter.hpp"
#include "hal/boards/stm32f405/ticker.hpp"
#include "hal/boards/stm32f405/usart.hpp"
#include "hal/boards/stm32f405/watchdog.hpp"
#include "hal/boards/stm32f405/watched_storage.hpp"

namespace whisker::hal::stm32f405 {

/// What every board with this chip has: time, console, CAN, watchdog and flash. Enough for a controller whose
/// sensors and wheels are another node of the bus.
///
///   board.start();
///   board.watch();
///   for (;;) { board.report(controller.status()); if (board.due(1)) controller.poll(board.now_ms()); }
class NodeBoard {
 public:
  static constexpr uint32_t kConsoleBaud = 115200;
  static constexpr uint32_t kCanBitrate = 500000;
  static constexpr uint16_t kWatchdogMs = 200;

  NodeBoard() noexcept
      : tables_(FlashUse::response_table, watchdog_, troubles_),
        calibration_(FlashUse::calibration, watchdog_, troubles_),
        reporter_(console_, troubles_, can_) {}
  NodeBoard(const NodeBoard&) = delete;
  NodeBoard& operator=(const NodeBoard&) = delete;

  /// Call once, before everything else; not yet the watchdog. Motors are off. Every wait in it is bounded: 20
  /// ms in total if nothing answers.
  void start() noexcept;
  /// Starts the watchdog, and the periods of due().
  void watch() noexcept;
  /// Serves the console; call it as often as possible. calibration: a word for it; null: there is none.
  void report(const Status& status, const char* calibration = nullptr) noexcept;
  /// True once per period. Also feeds the watchdog.
  bool due(uint32_t period_ms) noexcept;
  uint32_t now_ms() noexcept { return ticker_.now_ms(); }
  /// A number that differs from that of the last start: random, or the time if the chip gives no random
  /// number.
  uint16_t boot_number() noexcept;

  /// For what is kept without power.
  Storage& tables() noexcept { return tables_; }
  Storage& calibration() noexcept { return calibration_; }
  CanPort& can() noexcept { return can_; }
  Usart& console() noexcept { return console_; }
  Ticker& ticker() noexcept { return ticker_; }
  Troubles& troubles() noexcept { return troubles_; }
  const Troubles& troubles() const noexcept { return troubles_; }
  const Clocks& clocks() const noexcept { return clocks_; }

  void on_console_interrupt() noexcept { console_.on_interrupt(); }
  void on_can_interrupt() noexcept { can_.on_receive_interrupt(); }

 private:
  Troubles troubles_;
  Clocks clocks_ = kInternalClocks;
  Ticker ticker_;
  Usart console_;
  BxCan can_;
  Watchdog watchdog_;
  WatchedStorage tables_;
  WatchedStorage calibration_;
  Reporter reporter_;
  mcu::Schedule schedule_;
};

}  // namespace whisker::hal::stm32f405
