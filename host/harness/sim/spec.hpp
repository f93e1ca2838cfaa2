/// The simulated robot and its faults, SI units. The defaults are the reference robot without noise.
#pragma once

#include "firmware/params.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::sim {

/// A rangefinder on the body: its apex in the body's frame, x ahead, y to the left.
struct BeamSpec {
  double x = 0;                         ///< m
  double y = 0;                         ///< m
  double angle = 0;                     ///< rad, of its axis from straight ahead, counter-clockwise
  double cone_half_width = kPi / 14.4;  ///< rad; 0 < half width < pi/2
  double min_range = 0.02;              ///< m; nearer is too_near
  double max_range = 2.0;               ///< m; farther is clear; at most 65.5
};

struct RobotSpec {
  double radius = 0.09;           ///< m, of the disc body
  double track = 0.14;            ///< m, between the wheels; > 0
  double max_speed = 0.3;         ///< m/s; a faster command is limited to it
  double max_acceleration = 1.0;  ///< m/s^2, of each wheel; > 0
  double motor_lag = 0.05;        ///< s, time constant from command to wheel speed; 0 for none
  double counts_per_m = 5000;     ///< encoder counts, mean of both wheels
  double wheel_ratio = 1;         ///< travel per count of the right wheel / of the left wheel

  BeamSpec beams[3] = {{0, 0, kPi / 6}, {}, {0, 0, -kPi / 6}};  ///< left, front, right
  double rate_hz = 50;                                          ///< measurements a second; > 0
  double latency_s = 0.02;  ///< from a measurement to its arrival; rate * latency <= 30

  double incidence =
      kPi / 2;             ///< rad; a surface seen farther from its normal gives no echo; kPi / 2: each does
  double range_scale = 1;  ///< of every distance, as from another speed of sound
  double phantom = 0;      ///< probability that a clear reading becomes an echo at 0.1 to 0.5 m
  double crosstalk = 0;    ///< probability that a reading is a neighbouring beam's where that is nearer

  /// rad, half width of the cones at the distance taper_range; it falls linearly from cone_half_width at 0.
  /// Not less than 0; a larger one than cone_half_width counts as that: no taper.
  double cone_far_half_width = kPi / 2;
  double taper_range = 2.0;                  ///< m; > 0
  double corner_scatter = 0.5;               ///< m; up to it, ends of segments give an echo at any angle
  double echo_range = __builtin_huge_val();  ///< m; what is not nearer is too dark to give an echo
  bool dark_is_invalid = false;              ///< such a reading is invalid, not clear
  bool near_is_farther = false;  ///< a target at d, nearer than the minimum, reads as one at minimum^2 / d
  double soft_range = __builtin_huge_val();  ///< m; obstacles that absorb give an echo only if nearer
  double range_sigma = 0;                    ///< m, standard deviation of a distance
  double range_sigma_share = 0;              ///< the same, as a share of the distance
  double cover_glass = 0;                    ///< probability that a clear reading becomes an echo
  double cover_glass_at = 0.05;              ///< m, at this distance

  bool bumper = false;       ///< bump switches at the front half
  double press_speed = 0.1;  ///< m/s, of the body's centre; a faster touch is a contact all the same

  bool gyro = false;             ///< a yaw-rate gyro is fitted
  double gyro_range = 8.72665;   ///< rad/s, rate of a sample of 32768: 500 deg/s
  double gyro_rate_hz = 100;     ///< samples a second; > 0
  double gyro_latency_s = 0.01;  ///< from the end of a sample to its arrival; rate * latency <= 30
  double gyro_dies_s = __builtin_huge_val();  ///< from then on it does not answer

  double period_s = 0.01;  ///< control period; rounded to a whole number of milliseconds, at least 1
};

/// All zero: no noise.
struct NoiseSpec {
  double range_sigma_m = 0;      ///< standard deviation of a distance
  double range_dropout = 0;      ///< probability that a reading is lost
  double range_false_clear = 0;  ///< probability that a reading is wrongly clear
  double wheel_scale_sigma = 0;  ///< relative error of each wheel's encoder, drawn once per run
  double heading_drift_rad_per_sqrt_m =
      0;  ///< error of the odometry heading after 1 m; grows with the square root
  double wheel_scale_common_sigma = 0;  ///< the same error of both encoders, drawn once per run
  double wheel_slip = 0;  ///< mean share of a wheel's travel that is lost while it speeds up; at most 0.5
  double gyro_bias_radps = 0;           ///< standard deviation of the bias, drawn once per run
  double gyro_warm_up_radps = 0;        ///< of the change of the bias over kWarmUp, drawn once per run
  double gyro_walk_rad_per_sqrt_s = 0;  ///< angle random walk
  double gyro_scale_sigma = 0;          ///< relative error of the rate, drawn once per run
  double fix_every_m = 0;               ///< path between two fixes of the pose from outside; 0: none
  double fix_sigma_m = 0;               ///< standard deviation of each coordinate of a fix
  double fix_sigma_rad = 0;
};

/// The robot that the core's parameters describe.
RobotSpec robot_spec(const Params& params);

}  // namespace whisker::sim
