#pragma once

#include <stdint.h>

#include "firmware/apps/can/remote_board.hpp"
#include "firmware/apps/static_storage.hpp"
#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/planning/calibration/calibrator.hpp"
#include "firmware/robot.hpp"

namespace whisker::can_app {

/// Creates planners.
class PlannerMaker {
 public:
  /// A planner in its initial state. The parameters and the planner live until the next call.
  virtual planning::Planner& make(const Params& params) noexcept = 0;

 protected:
  ~PlannerMaker() = default;
};

/// A robot that is created anew for every mission, and steps on input sets.
class RemoteRobot {
 public:
  /// calibrator: drives the orders to calibrate, and changes the parameters of every mission; null: none.
  explicit RemoteRobot(PlannerMaker& planners, planning::Calibrator* calibrator = nullptr) noexcept
      : planners_(planners), calibrator_(calibrator) {}
  RemoteRobot(const RemoteRobot&) = delete;
  RemoteRobot& operator=(const RemoteRobot&) = delete;

  /// Orders that drive, except resume: with these parameters, from the mission's place. resume and cancel
  /// need a robot: see ready().
  void execute(can::Order order, const can::Mission& mission, const Params& params) noexcept;
  /// An order of the operator, from where the robot is: start creates it anew, and its PoseSigma begins at 0.
  /// Only when ready(), and not for a calibration.
  void execute_operator(can::Order order, const planning::Goal& goal, const Params& params) noexcept;
  bool ready() const noexcept { return robot_ != nullptr; }
  /// One control tick, at the time of the set's tick. Only when ready().
  const Status& step(const can::InputSet& set, bool braked) noexcept;
  /// What became of the fix in the last set that had one.
  can::FixStatus fix_status() const noexcept { return fix_status_; }

 private:
  void begin(planning::Planner& planner, const can::Mission& mission) noexcept;

  PlannerMaker& planners_;
  planning::Calibrator* const calibrator_;
  RemoteBoard board_;
  Params params_;
  can::FixStatus fix_status_ = can::FixStatus::accepted;
  Robot* robot_ = nullptr;
  StaticStorage<sizeof(Robot)> room_;
};

/// The bus message of a tick; the node sets its tick.
can::NavStatus nav_status(const Status& status) noexcept;
can::RangeTrustReport trust_report(const RangeTrust& trust) noexcept;
can::PoseSigmaReport sigma_report(const localization::Estimate& status) noexcept;
can::FixReply fix_reply(can::FixStatus status, const Health& health) noexcept;

}  // namespace whisker::can_app
