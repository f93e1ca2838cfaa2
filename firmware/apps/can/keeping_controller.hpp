#pragma once

#include "firmware/apps/can/controller.hpp"
#include "firmware/planning/default_planner.hpp"

namespace whisker::can_app {

/// A controller that keeps without power what its base sends and orders: the response table in one storage,
/// what it calibrates in another. About 34 KB.
///
///   static KeepingController node{port, {1, boot, version}, tables, calibration};
///   every millisecond:  node.controller().poll(now);
class KeepingController {
 public:
  /// Loads what the storages have; both must outlive it. The greeting has the table's hash.
  KeepingController(hal::CanPort& port, const can::Identity& identity, hal::Storage& tables,
                    hal::Storage& calibration) noexcept
      : store_(tables),
        loaded_(rules_.load()),
        calibrator_(calibration),
        controller_(port, identity, planners_, &rules_, &calibrator_) {}
  KeepingController(const KeepingController&) = delete;
  KeepingController& operator=(const KeepingController&) = delete;

  Controller& controller() noexcept { return controller_; }
  const Controller& controller() const noexcept { return controller_; }
  /// The active table.
  const fuzzy::Engine::Table& table() const noexcept { return rules_.active(); }
  /// What the storage of the tables had.
  fuzzy::Stored loaded() const noexcept { return loaded_; }
  const planning::Calibrator& calibrator() const noexcept { return calibrator_; }

 private:
  using Rules = can::RulesServerWith<2>;
  class Planners final : public PlannerMaker {
   public:
    explicit Planners(const Rules& rules) noexcept : rules_(rules) {}
    planning::Planner& make(const Params& params) noexcept override {
      return room_.make<planning::DefaultPlanner>(params, rules_.active()).planner;
    }

   private:
    const Rules& rules_;
    StaticStorage<sizeof(planning::DefaultPlanner)> room_;
  };

  fuzzy::TableStore store_;
  Rules rules_{fuzzy::kDefaultTable, &store_};
  const fuzzy::Stored loaded_;
  planning::Calibrator calibrator_;
  Planners planners_{rules_};
  Controller controller_;
};

}  // namespace whisker::can_app
