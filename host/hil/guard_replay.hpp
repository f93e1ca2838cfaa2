/// The part of a replay that belongs to a guard node.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "firmware/apps/can/remote_guard.hpp"
#include "firmware/can/messages.hpp"
#include "host/hil/overheard.hpp"

namespace whisker::hil {

/// Gives a guard the velocities that each GuardStatus says were asked. A GuardStatus belongs to the command
/// before it.
class GuardReplay {
 public:
  struct Step {
    hal::WheelSpeeds command{};
    std::string difference;  ///< between the recorded answer and that of the guard; "": none
  };

  void execute(can::Order order, const Params& params);
  /// Of the operator.
  void on_frame(const can::VouchRequest& vouch) { vouch_ = vouch; }
  /// The answer to a set; a stop means that the wheels were braked.
  void on_frame(const can::WheelCommand& command);
  /// Empty if it answers no set: the node does not drive.
  std::optional<can::WheelCommand> take() { return std::exchange(answer_, std::nullopt); }
  Step step(const can::InputSet& set, const can::WheelCommand& recorded, const can::GuardReport& told);
  bool ready() const { return guard_->ready(); }

 private:
  std::unique_ptr<can_app::RemoteGuard> guard_ = std::make_unique<can_app::RemoteGuard>();
  std::optional<can::VouchRequest> vouch_;
  std::optional<can::WheelCommand> answer_;
  bool vouched_ = false;
  bool braked_ = false;
};

}  // namespace whisker::hil
