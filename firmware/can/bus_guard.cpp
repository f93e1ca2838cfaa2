#include "firmware/can/bus_guard.hpp"

#include "firmware/can/limits.hpp"

namespace whisker::can {

void BusGuard::note_bus_off(uint32_t now_ms) noexcept {
  static_assert(kRemembered + 1 == kBusOffLimit);
  if (bus_offs_ >= kRemembered && now_ms - before_[0] < kBusOffWindow_ms) latched_ = true;
  for (int i = 1; i < kRemembered; ++i) before_[i - 1] = before_[i];
  before_[kRemembered - 1] = now_ms;
  ++bus_offs_;
}

void BusGuard::watch(hal::CanPort& port, uint32_t now_ms) noexcept {
  const hal::CanState state = port.state();
  const bool off = state == hal::CanState::bus_off;
  while (bus_offs_ < port.counts().bus_offs) note_bus_off(now_ms);
  on_bus_ = !latched_ && (state == hal::CanState::active || state == hal::CanState::passive);
  const bool silent = off || state == hal::CanState::off;
  if (silent && !silent_) silent_since_ = now_ms;
  silent_ = silent;
  if (!silent || latched_ || now_ms - silent_since_ < kRestartAfter_ms) return;
  silent_since_ = now_ms;
  port.restart();
}

}  // namespace whisker::can
