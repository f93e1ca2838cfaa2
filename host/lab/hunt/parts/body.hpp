/// A body with wheels and sensors that do what the parameters say, until a judge breaks one of them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "hal/bumper.hpp"
#include "hal/drive.hpp"
#include "hal/rangefinders.hpp"
#include "host/lab/hunt/parts/clutter.hpp"

namespace whisker::hunt {

class Body final : public hal::Rangefinders, public hal::Drive, public hal::Bumper {
 public:
  Body(const Params& p, Clutter world, sim::Pose at);
  /// A millisecond each.
  void pass(int ms);

  bool read(hal::RangeReadings& out) noexcept override;
  bool read(hal::EncoderCounts& out) noexcept override;
  bool read(hal::BumperReading& out) noexcept override;
  bool command(hal::WheelSpeeds speeds) noexcept override;

  const sim::Pose& pose() const { return pose_; }
  bool stands() const;
  /// Smallest distance between the body and what stands around it, m.
  double gap_m() const;

  Clutter world;
  hal::WheelSpeeds commanded{};
  bool refuses_ranges = false, refuses_counts = false, refuses_commands = false, refuses_bumper = false;
  int lost_beam = -1;                       ///< this one gives no readings
  std::array<double, 2> share{1, 1};        ///< of what is commanded, that a wheel turns
  std::array<double, 2> counted{1, 1};      ///< of what a wheel turns, that is counted
  std::array<std::uint32_t, 2> jump{0, 0};  ///< added to the counts
  std::uint8_t pressed = 0;

 private:
  struct Measured {
    std::int32_t at_ms;
    std::array<double, 3> distance_m;
  };
  void roll();
  void measure();

  const Params& p_;
  sim::Pose pose_;
  std::int32_t now_ms_ = 0, next_ms_ = 0;
  std::array<double, 2> v_{0, 0}, way_{0.3, 0.6}, reached_{0, 0};
  std::deque<Measured> measured_;
  std::uint8_t sequence_ = 0;
};

}  // namespace whisker::hunt
