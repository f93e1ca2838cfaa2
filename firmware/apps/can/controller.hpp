#pragma once

#include <stdint.h>

#include "firmware/apps/can/remote_robot.hpp"
#include "firmware/can/controller_node.hpp"

namespace whisker::can_app {

/// A whole controller: the core as a node of the bus.
///
///   Controller controller{port, {1, boot, version}, planners};
///   for (;;) controller.poll(clock.now_ms());
class Controller {
 public:
  /// rules: see ControllerNode; `planners` makes planners with its active table. calibrator: drives the
  /// orders to calibrate, and its values replace those of the base; null: such orders are refused.
  Controller(hal::CanPort& port, const can::Identity& identity, PlannerMaker& planners,
             can::RulesServer* rules = nullptr, planning::Calibrator* calibrator = nullptr) noexcept
      : node_(port, identity, rules), pilot_(planners, calibrator), calibrator_(calibrator) {
    if (calibrator != nullptr) node_.accept_calibrations();
    node_.accept_operator_orders();
  }

  /// Call it every millisecond. True: the core executed a step; status() is new. With a storage, it blocks as
  /// hal::Storage::erase() after a calibration, and as ControllerNode::poll().
  bool poll(uint32_t now_ms) noexcept {
    node_.poll(now_ms);
    if (unsaved_ && now_ms - ended_at_ms_ >= kSaveAfter_ms) {
      save();
      return false;
    }
    can::Order order = can::Order::cancel;
    can::Mission mission;
    if (node_.take_operator_order(order, mission.goal)) {
      pilot_.execute_operator(order, mission.goal, node_.params());
      ended_ = false;
    }
    if (node_.take_order(order, mission)) {
      save();
      pilot_.execute(order, mission, node_.params());
      ended_ = false;
    }
    report_calibration(now_ms);
    can::InputSet set;
    if (!pilot_.ready() || !node_.take_set(set)) return false;
    status_ = pilot_.step(set, node_.braked());
    const bool ends = status_.decision.outcome != planning::Outcome::running;
    node_.publish_trust(trust_report(status_.health.ranges), ends);
    if (status_.sigma_known) node_.publish_sigma(sigma_report(status_), ends);
    if (set.has_fix) node_.answer_fix(fix_reply(pilot_.fix_status(), status_.health));
    node_.answer(status_.command, nav_status(status_));
    const bool failed = status_.health.fault != Fault::none;
    node_.report(failed ? uint16_t{can::Error::core_fault} : uint16_t{0},
                 static_cast<uint8_t>(status_.health.fault));
    if (ends && !ended_ && calibrator_ != nullptr) {
      unsaved_ = true;
      ended_at_ms_ = now_ms;
    }
    ended_ = ends;
    return true;
  }

  const Status& status() const noexcept { return status_; }
  const can::ControllerNode& node() const noexcept { return node_; }
  can::ControllerNode& node() noexcept { return node_; }

 private:
  static constexpr uint32_t kReportEvery_ms = 125;
  static constexpr uint32_t kSaveAfter_ms = 100;

  /// Not with the last step: meanwhile no frame leaves, and the base would never learn that the mission ends.
  void save() noexcept {
    if (unsaved_) calibrator_->finish();
    unsaved_ = false;
  }

  void report_calibration(uint32_t now_ms) noexcept {
    if (calibrator_ == nullptr || now_ms - reported_ms_ < kReportEvery_ms) return;
    reported_ms_ = now_ms;
    const calibration::Measured& measured = calibrator_->values().of[reported_];
    can::CalibrationReport report;
    report.quantity = static_cast<calibration::Quantity>(reported_);
    report.trouble = calibrator_->trouble();
    report.stored = calibrator_->stored();
    report.value = static_cast<uint32_t>(measured.value);
    const int32_t sigma = measured.sigma.raw();
    report.sigma = static_cast<uint16_t>(
        sigma < can::CalibrationReport::kMostSigma ? sigma : can::CalibrationReport::kMostSigma);
    node_.publish_calibration(report);
    reported_ = static_cast<uint8_t>((reported_ + 1) % calibration::kQuantities);
  }

  can::ControllerNode node_;
  RemoteRobot pilot_;
  planning::Calibrator* const calibrator_;
  uint32_t reported_ms_ = 0;
  uint8_t reported_ = 0;  // the next quantity
  bool ended_ = false;    // the last step had an outcome
  bool unsaved_ = false;  // since ended_at_ms_: a calibration may have a result
  uint32_t ended_at_ms_ = 0;
  Status status_;
};

}  // namespace whisker::can_app
