/// The orders of one sender, each accepted once and taken once.
#pragma once

#include <stdint.h>

#include "firmware/can/mission.hpp"

namespace whisker::can {

/// `What`: what the program takes with an order.
template <class What>
class OrderBox {
 public:
  void on_frame(const MissionValue& part) noexcept { parts_.on_frame(part); }
  bool complete(const MissionOrder& order) const noexcept { return parts_.complete(order); }
  const MissionValues& values() const noexcept { return parts_.values(); }

  void accept(const MissionOrder& order, const What& what) noexcept {
    number_ = order.mission;
    numbered_ = true;
    order_ = order.order;
    what_ = what;
    taken_ = false;
  }
  /// False: none since the last call.
  bool take(Order& order, What& what) noexcept {
    if (taken_) return false;
    taken_ = true;
    order = order_;
    what = what_;
    return true;
  }
  bool taken() const noexcept { return taken_; }
  void drop() noexcept { taken_ = true; }

  /// Of the last order; 0 before the first one.
  uint8_t number() const noexcept { return number_; }
  /// This is the number of the last order: then the order is sent again.
  bool is_of(uint8_t mission) const noexcept { return numbered_ && mission == number_; }
  /// Numbers of the sender begin anew.
  void forget_number() noexcept { numbered_ = false; }
  void forget_parts() noexcept { parts_.forget(); }

 private:
  MissionParts parts_;
  What what_{};
  Order order_ = Order::cancel;
  uint8_t number_ = 0;
  bool numbered_ = false;  // number_ belongs to an accepted order
  bool taken_ = true;
};

}  // namespace whisker::can
