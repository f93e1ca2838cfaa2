#pragma once

#include "hal/boards/common/shared.hpp"
#include "hal/boards/stm32f405/clock.hpp"
#include "hal/ports/can_queue.hpp"

namespace whisker::hal::stm32f405 {

/// CAN1. An interrupt stores received frames in a ring. poll() fills the three mailboxes of the CAN
/// controller in the order of send(). The controller repeats a frame until it is sent or expires.
class BxCan final : public hal::CanPort {
 public:
  static constexpr uint32_t kHearUs = 2000;     ///< wait for the controller to change its mode
  static constexpr uint32_t kJoinMs = 100;      ///< wait for an idle bus; then `off`
  static constexpr uint8_t kQuantaPerBit = 14;  ///< sample point after 12 of them, 86 %

  /// bitrate: must divide apb1_hz by a multiple of kQuantaPerBit, or of 16: 500000 does at 42 and 16 MHz. All
  /// frames are received, without a filter.
  void start(uint32_t bitrate, const Clocks& clocks) noexcept;

  bool send(const hal::CanFrame& frame, uint8_t lifetime_ms) noexcept override;
  bool receive(hal::CanFrame& out) noexcept override;
  void poll(uint32_t now_ms) noexcept override;
  void restart() noexcept override;
  hal::CanState state() const noexcept override { return state_; }
  const hal::CanCounts& counts() const noexcept override { return counts_; }

  /// Interrupt handler of receive FIFO 0.
  void on_receive_interrupt() noexcept;

 private:
  struct Mailbox {
    bool busy = false;
    bool given_up = false;  // abort of its frame requested
    uint32_t until_ms = 0;
  };
  bool initialise(uint32_t apb1_hz) noexcept;
  void see_state() noexcept;
  void collect() noexcept;
  void drop_stale() noexcept;
  void fill() noexcept;
  void drop_all() noexcept;
  void load_mailbox(uint8_t box, const hal::CanFrame& frame) noexcept;
  bool on_bus() const noexcept { return state_ == hal::CanState::active || state_ == hal::CanState::passive; }

  uint32_t bitrate_ = 0;
  Clocks clocks_ = kInternalClocks;
  hal::CanState state_ = hal::CanState::off;
  hal::CanCounts counts_;
  uint32_t now_ms_ = 0;
  uint32_t started_ms_ = 0;
  bool join_timed_ = false;
  hal::CanOutbox outbox_;
  Mailbox mailbox_[3];
  mcu::Ring<hal::CanFrame, kReceiveDepth> received_;
  mcu::Events overruns_;
};

}  // namespace whisker::hal::stm32f405
