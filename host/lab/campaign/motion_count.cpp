#include "host/lab/campaign/motion_count.hpp"

#include <cmath>

namespace whisker::campaign {

void MotionCount::add(const TickRecord& record) {
  if (!first_) turned_rad_ += std::fabs(record.heading_rad - heading_rad_);
  first_ = false;
  heading_rad_ = record.heading_rad;
  add_speed((record.v_left_mps + record.v_right_mps) / 2);
  add_turn_rate((record.v_right_mps - record.v_left_mps) / track_m_);
  if (record.looked && !looked_) ++looks_;
  looked_ = record.looked;
}

void MotionCount::add_speed(double speed_mps) {
  if (speed_mps > kDriving_mps) {
    // Counted when the robot drives on, so that the final stop does not count.
    if (pace_ == Pace::standing) ++stops_;
    pace_ = Pace::driving;
  } else if (speed_mps < kStanding_mps && pace_ == Pace::driving) {
    pace_ = Pace::standing;
  }
}

void MotionCount::add_turn_rate(double rate_radps) {
  if (std::fabs(rate_radps) <= kTurning_radps) return;
  const int side = rate_radps > 0 ? 1 : -1;
  if (side_ == -side) ++flips_;
  side_ = side;
}

}  // namespace whisker::campaign
