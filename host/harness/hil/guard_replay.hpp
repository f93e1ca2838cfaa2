/// The part of a replay that belongs to a guard node.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "firmware/apps/can/remote_guard.hpp"
#include "firmware/can/messages.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::hil {

/// What `who` answers now instead of what is recorded; "": the same.
std::string difference_of(const can::WheelCommand& recorded, const char* who, const hal::WheelSpeeds& now);

/// Gives a guard the velocities that each GuardStatus says were asked. A GuardStatus belongs to the command
/// before it. A log may lack it: the node sends it once, and drops it if the bus takes it too late. Then the
/// operator's own frames say what was asked.
class GuardReplay {
 public:
  /// A recorded answer to a set, and what the operator had asked when it was given.
  struct Answer {
    can::WheelCommand command;
    can::VelocityCommand asked;
    bool heard = false;  ///< since the answer before
    bool vouched = false;
  };
  struct Step {
    hal::WheelSpeeds command{};
    std::string difference;  ///< between the recorded answer and that of the guard; "": none
  };

  void execute(can::Order order, const Params& params);
  /// Of the operator.
  void on_frame(const can::VelocityCommand& velocity);
  void on_frame(const can::VouchRequest& vouch) { vouch_ = vouch; }
  /// The answer to a set; a stop means that the wheels were braked.
  void on_frame(const can::WheelCommand& command);
  /// The last answer. Empty if it is taken already, or the node does not drive.
  std::optional<Answer> take() { return std::exchange(answer_, std::nullopt); }
  bool waits() const { return answer_.has_value(); }
  /// It belongs to an answer. A node that waits for a set says command_timeout, too, but grants nothing: a
  /// step without a command grants all of it.
  static bool of_a_step(const can::GuardReport& told);
  /// told: null if the log lacks it.
  Step step(const can::InputSet& set, const Answer& recorded, const can::GuardReport* told);
  bool ready() const { return guard_->ready(); }

 private:
  std::unique_ptr<can_app::RemoteGuard> guard_ = std::make_unique<can_app::RemoteGuard>();
  std::optional<can::VouchRequest> vouch_;
  std::optional<Answer> answer_;
  std::optional<can::VelocityCommand> said_;  // since the last answer
  can::VelocityCommand asked_;                // by the operator, at the time below
  Time asked_at_;
  bool armed_ = false;  // as can::OperatorInbox
  bool still_ = false;  // as GuardController: a Vouch counts
  bool vouched_ = false;
  bool braked_ = false;
};

}  // namespace whisker::hil
