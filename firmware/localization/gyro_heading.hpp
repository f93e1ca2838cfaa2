/// The turn of the body by the gyro, or by the wheels while there is none.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/localization/gyro_bias.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/localization/wheel_gains.hpp"
#include "firmware/math/angle.hpp"
#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::localization {

/// What turns the pose.
enum class HeadingSource : uint8_t {
  wheels,        ///< no gyro is fitted
  bias_unknown,  ///< the wheels, until the robot has stood long enough to measure the bias
  gyro,
  gyro_lost,  ///< the wheels, with what the gyro taught within their declared error, until it answers again
};

/// The gyro counts for the heading, the wheels for the distance. Where no sample has arrived since the last
/// step, the wheels turn the body meanwhile, and the next sample takes that back. If none arrives for 100 ms,
/// or more than half a second's worth at once, the gyro is lost: the heading of the wheels stays.
class GyroHeading {
 public:
  struct Step {
    const hal::GyroReading* reading = nullptr;  ///< null: it does not answer
    CountStep counts;
    bool commanded = false;  ///< a wheel is commanded to turn
    Duration elapsed;
  };

  void configure(const Params& params, const Odometry& odometry) noexcept;
  /// The body was put down elsewhere.
  void restart() noexcept;
  Angle turn(const Step& step, const Odometry& odometry, Health& health) noexcept;
  /// Counts have been lost: the stretch that is being compared teaches nothing.
  void drop_stretch() noexcept { gains_.drop(); }

  HeadingSource source() const noexcept;
  GyroBias& bias() noexcept { return bias_; }
  /// The robot should stand now to measure the bias.
  bool wants_rest() const noexcept { return answers_ && bias_.due(); }

 private:
  struct Samples {
    int32_t sum = 0;
    int32_t count = 0;
  };
  Samples take(const Step& step, Health& health) noexcept;
  void learn(const CountStep& counts, Angle gyro, Angle nominal, Health& health) noexcept;
  Angle turned(Samples samples) const noexcept;

  GyroBias bias_;
  WheelGains gains_;
  hal::GyroReading last_{};
  uint32_t turn_per_unit_ = 0;  // 2^-44 turn
  Angle ahead_;                 // turned by the wheels since the last sample
  Duration silent_for_;
  bool answers_ = true;
  bool has_last_ = false;
  uint8_t most_samples_ = 0;  // at once
};

}  // namespace whisker::localization
