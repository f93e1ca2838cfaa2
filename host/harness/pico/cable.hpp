#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "firmware/can/codec.hpp"
#include "firmware/robot.hpp"
#include "hal/ports/slcan/slcan.hpp"
#include "host/harness/hil/operator_orders.hpp"
#include "host/harness/hil/replayer.hpp"
#include "host/harness/hil/tap.hpp"

namespace whisker::pico {

/// The bytes on the way between the chip and this end.
class Bytes final : public hal::ByteLine {
 public:
  void arrive(const std::string& bytes) { in_.insert(in_.end(), bytes.begin(), bytes.end()); }
  std::string leave() { return std::exchange(out_, {}); }

  std::size_t take(std::uint8_t* to, std::size_t room) noexcept override;
  std::size_t offer(const std::uint8_t* from, std::size_t count) noexcept override;
  bool ready() noexcept override { return true; }

 private:
  std::deque<std::uint8_t> in_;
  std::string out_;
};

/// The operator at the other end of a robot's cable, in simulated time: gives it the parameters and a goal,
/// and compares every answer of its core with that of a core on this computer.
class Cable {
 public:
  Cable(const Params& params, PlannerKind planner, const planning::Goal& goal);

  /// Every millisecond. came: from the robot. Returns what goes to it.
  std::string step(std::uint64_t now_us, const std::string& came);
  /// Whether it also gives parameters and a goal, or only listens.
  void listen_only() { listens_ = true; }

  /// Why the robot gets no goal: it refuses a parameter, or the goal, or gives no answer. "": it gets it.
  const std::string& trouble() const { return trouble_; }
  /// The goal was accepted.
  bool ordered() const { return phase_ == Phase::drives; }
  std::uint64_t ordered_us() const { return ordered_us_; }
  /// Of the last answer.
  const can::NavStatus& status() const { return status_; }
  const can::WheelCommand& command() const { return command_; }
  const can::Heartbeat& controller() const { return controller_; }
  const can::Heartbeat& base() const { return base_; }
  std::uint64_t frames() const { return frames_; }
  std::uint64_t answers() const { return answers_; }  ///< that were compared
  /// The core on this computer after its last tick; null: it has taken none.
  const hil::Shadow* shadow() const { return shadow_ && followed_ ? &*shadow_ : nullptr; }
  /// The first answer that the core on this computer would not have given; "": none.
  std::string difference() const { return shadow_ ? shadow_->difference() : std::string(); }

 private:
  enum class Phase { waits, sends, commits, rests, orders, drives, gave_up };

  void hear(const hal::CanFrame& frame);
  void act();
  /// True: it is done. What is refused, or not answered, ends the talk.
  bool asked(const can::ParamRequest& request);
  void enter(Phase phase);
  void give_up(const std::string& why);
  bool runs() const;
  template <class M>
  void send(const M& message);

  const Params params_;
  const PlannerKind planner_;
  const planning::Goal goal_;
  Bytes bytes_;
  hal::slcan::Slcan line_{bytes_, hal::slcan::Role::host};
  hil::Tap tap_;
  hil::OperatorOrders orders_;
  std::optional<hil::Shadow> shadow_;
  std::uint64_t now_us_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t answers_ = 0;
  Phase phase_ = Phase::waits;
  bool listens_ = false;
  bool followed_ = false;
  bool speaks_ = false;  // the robot does
  std::uint8_t index_ = 0;
  std::optional<can::ParamReply> reply_;
  std::string trouble_;
  std::optional<std::uint64_t> asked_us_;
  can::AliveSender alive_;
  std::uint64_t since_us_ = 0;  // of the phase, or of the parameter
  std::uint64_t ordered_us_ = 0;
  can::NavStatus status_;
  can::WheelCommand command_;
  can::Heartbeat controller_, base_;
};

}  // namespace whisker::pico
