#pragma once

#include <memory>
#include <optional>

#include "host/harness/run/core_pilot.hpp"
#include "host/harness/run/link_loss.hpp"

namespace whisker {

/// Drives with the core in this process, and does with each event what a base does on a bus.
class EventPilot final : public Pilot {
 public:
  EventPilot(const Scenario& scenario, PlannerKind planner, sim::Plant& plant);
  const Status& tick(Time now) override;
  bool play(const Event& event) override;
  bool hears() const override { return !loss_.lost(); }
  const perception::LocalGrid* local_grid() const override { return core_->local_grid(); }
  std::optional<RangeTrust> ranges() const override { return core_->ranges(); }
  std::optional<localization::PoseSigma> sigma() const override { return core_->sigma(); }
  const RecordingGuide* guide() const override { return core_->guide(); }

 private:
  bool faulted() const { return core_->status().health.fault != Fault::none; }
  void start();
  bool aim(const Goal& goal);
  bool change(bool changed);
  bool choose_table(const Event& event);
  bool lose(double for_s);
  bool restart();
  const Status& stay(bool brakes);

  sim::Plant& plant_;
  FixSource fixes_;
  LinkLoss loss_;
  Scenario next_;  // of the next start
  PlannerKind kind_;
  bool changed_ = false;  // since the last start: the parameters, or the table
  std::optional<localization::UncertainPose> fix_;
  std::unique_ptr<const Scenario> driven_;
  std::unique_ptr<CorePilot> core_;
  Status away_;  // without a controller
};

}  // namespace whisker
