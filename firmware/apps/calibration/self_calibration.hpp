#pragma once

#include <stdint.h>

#include "firmware/apps/static_storage.hpp"
#include "firmware/planning/calibration/calibrator.hpp"
#include "firmware/robot.hpp"
#include "hal/button.hpp"

namespace whisker {

/// A robot that calibrates itself when a person presses its button. A brief press starts the straight drive,
/// kStraight there and back; a held one the spin. It brakes, stands for kHandsOff, drives the mission under
/// the guard, and saves what it finds. Then it stands until the next press. A press while it calibrates ends
/// that; so does a fault. Before the first press, the usual robot drives.
///
/// The usual robot never drives again: its planner has the parameters from before. Switch the board off and
/// on, so that it starts with what was found.
///
///   SelfCalibration robot{usual, calibrator, params, board.button(), {rangefinders, drive, &bumper, &gyro}};
///   every 10 ms:  robot.tick(now);
class SelfCalibration {
 public:
  enum class Phase : uint8_t {
    none,       ///< not pressed yet
    starts,     ///< it stands, so that the person can step back
    measures,   ///< it drives
    cancelled,  ///< by a press or a fault
    ended,      ///< with a result, or for the reason Calibrator::trouble()
  };
  static constexpr planning::Arrow<Phase> kArrows[] = {
      {Phase::none, Phase::starts},      {Phase::cancelled, Phase::starts},
      {Phase::ended, Phase::starts},     {Phase::starts, Phase::measures},
      {Phase::starts, Phase::cancelled}, {Phase::measures, Phase::cancelled},
      {Phase::measures, Phase::ended},
  };
  static constexpr Duration kHandsOff = milliseconds(3000);
  static constexpr Length kStraight = 3000_mm;

  /// Those of the usual robot; null: there is none.
  struct Devices {
    hal::Rangefinders& rangefinders;
    hal::Drive& drive;
    hal::Bumper* bumper;
    hal::Gyro* gyro;
  };

  /// params: those of the board, without what is kept. All must outlive it.
  SelfCalibration(Robot& usual, planning::Calibrator& calibrator, const Params& params, hal::Button& button,
                  const Devices& devices) noexcept
      : usual_(usual), calibrator_(calibrator), bare_(params), button_(button), devices_(devices) {}
  SelfCalibration(const SelfCalibration&) = delete;
  SelfCalibration& operator=(const SelfCalibration&) = delete;

  /// As Robot::tick(). After a calibration with a result it blocks as hal::Storage::erase(), once, with the
  /// wheels commanded to stand.
  const Status& tick(Time now) noexcept;
  const Status& status() const noexcept { return active().status(); }

  Phase phase() const noexcept { return phase_; }
  /// A word for people: null before the first press; then `starts`, `measures`, `cancelled`; at the end, the
  /// name of the trouble, or of what became of the save: `ok`.
  const char* word() const noexcept;

 private:
  Robot& active() noexcept { return own_ != nullptr ? *own_ : usual_; }
  const Robot& active() const noexcept { return own_ != nullptr ? *own_ : usual_; }
  void on_press(hal::Press press, Time now) noexcept;
  void begin() noexcept;
  void watch(const Status& status) noexcept;

  Robot& usual_;
  planning::Calibrator& calibrator_;
  const Params& bare_;
  hal::Button& button_;
  const Devices devices_;
  Params params_;  // of the mission
  Phase phase_ = Phase::none;
  hal::Press wanted_ = hal::Press::none;
  Time pressed_at_;
  Robot* own_ = nullptr;
  StaticStorage<sizeof(Robot)> room_;
};

}  // namespace whisker
