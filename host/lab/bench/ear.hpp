/// What a robot says for a while, a tick at a time: the readings of a check list.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "firmware/can/pose_messages.hpp"
#include "host/lab/bench/bus_state.hpp"

namespace whisker::bench {

inline constexpr const char* kSides[] = {"left", "front", "right"};  ///< indexed by hal::Beam

class Ear {
 public:
  explicit Ear(int robot) : robot_(robot) {}

  /// Every frame on the bus.
  void on_frame(const hal::CanFrame& frame);

  std::uint32_t ticks() const { return ticks_; }
  std::uint32_t missed() const { return missed_; }
  double time_s() const;  ///< of these ticks
  /// Of both wheels since it began, encoder counts.
  const std::array<std::int32_t, 2>& turned() const { return turned_; }
  /// Ticks since a wheel has turned.
  std::uint32_t stood() const { return stood_; }

  /// Ticks in a row in which this beam had the nearest echo, within 0.3 m; negative: in which it had not.
  int nearest(int beam) const { return beams_[beam].nearest; }
  int measurements(int beam) const { return beams_[beam].measurements; }
  /// Of these, how many proved nothing.
  int without_proof(int beam) const;
  /// "75 measurements, ok 75, 1.106 to 1.217 m"
  std::string measured(int beam) const;
  /// "left 0.10 m, front 0.69 m, right nothing": the last ones.
  std::string ranges() const;

  /// Mean of the gyro's samples, of their units; empty: it gave none.
  std::optional<double> gyro_mean() const;

 private:
  struct Beam {
    int nearest = 0;
    int measurements = 0;
    int of[5] = {};  // by status
    std::optional<std::uint8_t> sequence;
    std::uint16_t least_mm = 0, most_mm = 0;
  };
  double distance_mm(int beam) const;
  void on_tick();
  void on_range(int beam);
  void on_wheels();
  void on_gyro(const can::GyroState& now);

  const int robot_;
  BusState state_;
  std::optional<std::uint32_t> tick_;
  std::uint32_t ticks_ = 0, missed_ = 0, stood_ = 0;
  std::array<std::int32_t, 2> turned_{};
  std::optional<hal::EncoderCounts> counts_;
  Beam beams_[hal::kBeams];
  std::optional<can::GyroState> gyro_;
  std::int64_t sum_ = 0, samples_ = 0;
};

}  // namespace whisker::bench
