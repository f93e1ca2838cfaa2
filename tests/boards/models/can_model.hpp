#pragma once

#include <deque>
#include <vector>

#include "hal/boards/stm32f405/reg/can.hpp"
#include "hal/can_port.hpp"
#include "tests/boards/models/chip.hpp"

namespace whisker::hal::stm32f405::model {

/// bxCAN and its bus.
class CanModel : public Peripheral {
 public:
  CanModel();
  std::uint32_t load(std::uint32_t offset) override;
  void store(std::uint32_t offset, std::uint32_t value) override;
  void advance() override;

  /// A frame arrives from the bus. Returns whether the interrupt is raised.
  bool receive(const hal::CanFrame& frame);
  /// Errors beyond the limit.
  void go_bus_off();
  void go_passive() { put(can::kEpvf, 1); }
  double bitrate(double clock_hz);
  double sample_point();

  enum class Bus { fine, nobody_hears, others_win, held };
  Bus bus = Bus::fine;  // held: the bus is never idle, so nothing starts
  bool dead = false;    // the controller does not respond
  std::vector<hal::CanFrame> sent;

 private:
  static constexpr int kFrame = 500;  // polls
  bool in_init() { return get(can::kInak) != 0; }
  void complete(std::uint8_t box, bool ok);

  int left_[can::kMailboxes] = {};
  int joining_ = 0;
  std::vector<std::uint8_t> order_;
  std::deque<hal::CanFrame> fifo_;
};

}  // namespace whisker::hal::stm32f405::model
