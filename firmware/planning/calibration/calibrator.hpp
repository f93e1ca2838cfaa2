/// The missions of a calibration on a robot that keeps what they find.
#pragma once

#include "firmware/calibration/store.hpp"
#include "firmware/planning/calibration/spin_planner.hpp"
#include "firmware/planning/calibration/straight_planner.hpp"

namespace whisker::planning {

/// Values are measured one mission after the other; a save keeps those of earlier missions. Each mission must
/// drive with parameters that have the values of the ones before: see apply(). About 10 KB.
///
///   calibrator.apply(params);
///   Robot robot{..., calibrator.spin(params), params, ...};   // then a goal, and ticks until it is reached
///   if (the outcome is not Outcome::running) calibrator.finish();
///
/// Virtual, so that a program that is given none does not contain the planners.
class Calibrator {
 public:
  /// Loads what the storage has, which must outlive it.
  explicit Calibrator(hal::Storage& storage) noexcept;
  Calibrator(const Calibrator&) = delete;
  Calibrator& operator=(const Calibrator&) = delete;

  /// The planner of the next mission, which drives with these parameters. It ends a mission before.
  virtual Planner& spin(const Params& params) noexcept;
  /// There and back; length: see StraightPlanner.
  virtual Planner& straight(const Params& params, Length length) noexcept;
  /// Along a tape, one way. It measures nothing before take_tape(): until then, its trouble is not_finished.
  virtual Planner& tape(const Params& params, Length length) noexcept;
  /// The same planner begins its mission anew, after a fault.
  virtual void begin_anew() noexcept;
  /// The robot does something else: finish() has no effect until the next mission.
  virtual void abandon() noexcept;

  /// Call it once when a mission ends, as the wheels then stand: saves the values if there are any. Blocks as
  /// hal::Storage::erase().
  virtual void finish() noexcept;
  /// How far the last mission went by the tape. Saves what follows, as finish() does. The mission must have
  /// been tape(); it counts once.
  virtual void take_tape(Length measured) noexcept;

  /// Writes the kept values into the parameters, if check() accepts them together.
  virtual void apply(Params& params) const noexcept;

  /// Of all missions; those that a save could not keep are lost.
  const calibration::Values& values() const noexcept { return values_; }
  /// Of the last mission.
  Trouble trouble() const noexcept { return trouble_; }
  /// Result of the last save, or of the load.
  calibration::Stored stored() const noexcept { return stored_; }

 private:
  void begin(const Params& params, CalibrationPlanner& planner) noexcept;
  void keep(const calibration::Values& all) noexcept;

  calibration::Store store_;
  calibration::Values values_;
  calibration::Stored stored_;
  Trouble trouble_ = Trouble::not_finished;
  Params params_;
  SpinPlanner spin_;
  StraightPlanner straight_;
  CalibrationPlanner* runs_ = nullptr;
  bool along_tape_ = false;  // what runs_
  Length driven_;            // along a tape that is not read yet; 0: none
};

}  // namespace whisker::planning
