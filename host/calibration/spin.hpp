/// The drive of the calibration: on the spot, once around and back.
#pragma once

#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::calibration {

/// Commands the wheels of one tick after the other. Half a degree passes between two measurements, if that
/// speed is within 8 to 25 degrees a second.
class Spin {
 public:
  explicit Spin(const Params& params);

  /// turned_rad: by odometry since the first call. t_s: since the first call.
  hal::WheelSpeeds step(double turned_rad, double t_s);
  bool done() const { return phase_ == Phase::done; }
  /// The wheels do not turn as commanded.
  bool failed() const { return phase_ == Phase::failed; }
  /// s, of the whole drive.
  double duration_s() const;

 private:
  enum class Phase { settle, forth, pause, back, last, done, failed };
  void enter(Phase phase, double t_s);
  hal::WheelSpeeds turning(int sign) const;

  double rate_rad_s_;
  double rim_m_s_;
  Phase phase_ = Phase::settle;
  double entered_s_ = 0;
};

}  // namespace whisker::calibration
