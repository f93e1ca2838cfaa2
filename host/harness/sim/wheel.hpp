/// One driven wheel: a first-order lag behind the command, with an acceleration limit.
#pragma once

namespace whisker::sim {

struct WheelStep {
  double speed;     ///< m/s at the end
  double distance;  ///< m rolled
};

/// dv/dt = (target - v) / lag, limited to +-max_acceleration; solved in closed form over one fixed step, so
/// that the step length does not change the result. The speed stays between v and the target.
class WheelModel {
 public:
  /// lag_s >= 0, max_acceleration > 0 (m/s^2), step_s > 0.
  WheelModel(double lag_s, double max_acceleration, double step_s);

  /// From the speed v towards the target, m/s. A remainder below 1e-12 m/s is dropped.
  WheelStep step(double v, double target) const;

 private:
  double lag_;
  double max_acceleration_;
  double step_;
  double decay_;  // decay of the remainder over one whole step
};

}  // namespace whisker::sim
