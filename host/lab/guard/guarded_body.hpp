/// The simulated robot behind the guard, one tick at a time: `whisker guard` and the playground drive it.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/apps/command_hash.hpp"
#include "firmware/guard.hpp"
#include "host/harness/run/braked_wheels.hpp"
#include "host/harness/run/link_loss.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/harness/sim/plant.hpp"
#include "host/harness/sim/sim_board.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::guard {

/// In the guard's units, rounded; values that they do not hold become the nearest.
Velocity velocity(const Twist& twist);

/// Everything observable at one tick; valid during the call only.
struct Moment {
  double t_s = 0;
  sim::Pose pose;  ///< true
  double v_left_mps = 0, v_right_mps = 0;
  hal::RangeReadings ranges{};
  Twist asked;                                  ///< the last command
  hal::WheelSpeeds command{};                   ///< as sent to the wheels
  const GuardStatus* status = nullptr;          ///< null without the guard
  const perception::LocalGrid* grid = nullptr;  ///< null without the guard
};

/// How the commands reach the wheels.
struct Wiring {
  bool guarded = true;  ///< false: the wheels do what is asked, within their limits
  GuardParams guard;
  double vouched_m = 0;                           ///< the operator vouches for this radius around the start
  const fuzzy::Bilinear::Table* table = nullptr;  ///< of the assist; null: the core's own
};

/// Call tick() and pass() in turn.
class GuardedBody {
 public:
  /// Stands at the scenario's start. `fine`: the gaps between ticks are whole milliseconds of any number;
  /// otherwise each is the control period. World and table must outlive it.
  GuardedBody(const Scenario& scenario, const sim::WorldView& world, const Wiring& wiring, bool fine = false);
  GuardedBody(const GuardedBody&) = delete;
  GuardedBody& operator=(const GuardedBody&) = delete;

  /// Replaces the command from the next tick on.
  void command(const Twist& twist);
  Moment tick();
  /// An event between two ticks. False: it is refused, or means nothing to a guard.
  bool play(const Event& event);
  /// False: frames are lost, or the guard restarts.
  bool hears() const { return !loss_.lost(); }
  /// Time passes until the next tick.
  void pass(int gap_ms);

  /// Wires anew, with a new guard that is put down here. The body must stand.
  void wire(const Wiring& wiring);

  const sim::Plant& plant() const { return plant_; }
  const Wiring& wiring() const { return wiring_; }
  bool stands() const;
  bool faulted() const { return wiring_.guarded && guard_->status().health.fault != Fault::none; }
  const GuardStatus& status() const { return guard_->status(); }
  const perception::LocalGrid* local_grid() const {
    return wiring_.guarded ? &guard_->local_grid() : nullptr;
  }
  /// Where the estimate of the guard began at zero.
  const sim::Pose& put_down() const { return put_down_; }
  const Twist& asked() const { return twist_; }
  /// As sent to the wheels at the last tick.
  hal::WheelSpeeds sent() const;
  /// Over the commands of the guard.
  std::uint64_t hash() const { return hash_.value(); }

 private:
  Time now() const { return Time::from_raw(now_ms_); }
  void without_guard();
  void make_guard();
  /// False: no tick of the guard; the base holds the last command, or brakes.
  bool regain();

  bool fine_;
  Params params_;
  Wiring wiring_;
  sim::Plant plant_;
  hal::SimBoard board_;
  BrakedWheels wheels_;
  LinkLoss loss_;
  hal::WheelSpeeds away_{};  // the last command while a loss lasts
  bool is_away_ = false;
  Params next_params_;  // of the next start
  const fuzzy::Bilinear::Table* next_table_ = nullptr;
  std::optional<Guard> guard_;
  sim::Pose put_down_;
  WheelPair bare_;
  CommandHash hash_;
  Twist twist_;
  int gap_ms_ = 10;
  std::uint32_t now_ms_ = 0;
};

}  // namespace whisker::guard
