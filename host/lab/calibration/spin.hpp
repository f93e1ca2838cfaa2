/// The drive of the calibration: on the spot, half around to the left, once around to the right, and back; if
/// wanted, a second time beside.
#pragma once

#include <vector>

#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::calibration {

/// Commands the wheels of one tick after the other. Half a degree passes between two measurements, if that
/// speed is within 8 to 25 degrees a second.
class Spin {
 public:
  /// along_m: 0, or the length of a straight drive to the right, along the wall, to the place of the second
  /// turn.
  explicit Spin(const Params& params, double along_m = 0);

  /// turned_rad: by odometry since the first call. from_start_m: the distance from the first place by
  /// odometry. t_s: since the first call.
  hal::WheelSpeeds step(double turned_rad, double from_start_m, double t_s);
  bool done() const { return at_ == moves_.size(); }
  /// The wheels do not turn as commanded.
  bool failed() const { return failed_; }
  /// s, of the whole drive.
  double duration_s() const;

 private:
  struct Move {
    enum class Kind { rest, left, right, ahead } kind;
    double until;  ///< s, rad or m
    double usual_s;
  };
  static bool complete(const Move& move, double turned_rad, double from_start_m, double since_s);
  void turn_to(double rad);

  double rate_rad_s_;
  double rim_m_s_;
  double turned_to_ = 0;
  std::vector<Move> moves_;
  std::size_t at_ = 0;
  bool failed_ = false;
  double entered_s_ = 0;
};

}  // namespace whisker::calibration
