#pragma once

#include <stdint.h>

#include "firmware/apps/can/remote_board.hpp"
#include "firmware/apps/static_storage.hpp"
#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/operator_messages.hpp"
#include "firmware/guard.hpp"

namespace whisker::can_app {

/// A guard that is created anew for every order to start, and steps on input sets.
class RemoteGuard {
 public:
  RemoteGuard() = default;
  RemoteGuard(const RemoteGuard&) = delete;
  RemoteGuard& operator=(const RemoteGuard&) = delete;

  /// Guard::assist_by, for all guards made later.
  void assist_by(const fuzzy::Bilinear::Table& table) noexcept { table_ = &table; }
  /// start: with these parameters. Every order drops the command and all that was seen.
  void execute(can::Order order, const Params& params) noexcept;
  bool ready() const noexcept { return guard_ != nullptr; }
  /// The guard of the last start. Only when ready().
  Guard& guard() noexcept { return *guard_; }
  /// One control tick, at the time of the set. Only when ready().
  const GuardStatus& step(const can::InputSet& set, bool braked) noexcept;

 private:
  RemoteBoard board_;
  Params params_;
  Guard* guard_ = nullptr;
  const fuzzy::Bilinear::Table* table_ = nullptr;
  StaticStorage<sizeof(Guard)> room_;
};

/// The clock of the guard at a set.
constexpr Time time_of(const can::InputSet& set) noexcept { return Time::from_raw(set.tick * set.period_ms); }
Velocity velocity_of(const can::VelocityCommand& command) noexcept;
/// The messages of a tick; the node sets the tick.
can::NavStatus nav_status(const GuardStatus& status) noexcept;
can::GuardReport guard_report(const GuardStatus& status) noexcept;

}  // namespace whisker::can_app
