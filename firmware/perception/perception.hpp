/// From range readings to what is known of the surroundings.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/localization/pose_history.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/perception/motion_detector.hpp"
#include "firmware/perception/percept.hpp"
#include "firmware/perception/range_conditioner.hpp"
#include "firmware/perception/range_scatter.hpp"
#include "hal/types.hpp"

namespace whisker::perception {

/// Where the body is at a tick, and whether and since when it stands.
struct Standing {
  Pose pose;
  Time now;
  bool settled = false;
  Time settled_since;
};

/// The second stage: conditions the readings, and marks the local grid with them.
class Perception {
 public:
  void configure(const Params& params) noexcept;
  /// No reading has come yet; from `now` on, they may be waited for.
  void start(Time now) noexcept { conditioner_.reset(now); }
  /// The body was put down here: the grid knows nothing but what must be free around it.
  void place(const Pose& pose) noexcept;
  /// Nothing is known but the ground under the body: it may not be where it was thought to be.
  void forget(const Pose& pose) noexcept;
  /// Between the last tick and the next one the body moved in a way that nobody followed.
  void lose_history() noexcept { history_.reset(); }

  /// Takes the readings of a tick. readings == nullptr: the HAL refused.
  void sense(const hal::RangeReadings* readings, Time now, Angle heading, const Params& params,
             Health& health) noexcept;
  /// Marks what the beams show, once a tick after sense(), and says what is known.
  void observe(const Standing& body, const Params& params, Percept& out) noexcept;

  /// The latest reading of each beam by itself.
  Echoes latest() const noexcept { return conditioner_.latest(); }
  /// The longest time for which some beam has had no usable reading.
  Duration lost_for(Time now) const noexcept { return conditioner_.lost_for(now); }
  const LocalGrid& local_grid() const noexcept { return local_grid_; }

 private:
  RangeConditioner conditioner_;
  localization::PoseHistory history_;
  LocalGrid local_grid_;
  MotionDetector motion_;
  RangeScatter scatter_[hal::kBeams];
  EarlierObservation last_[hal::kBeams];  // reading of each beam, if it is
  uint8_t seen_ = 0;                      // a bit for each beam that has one
};

}  // namespace whisker::perception
