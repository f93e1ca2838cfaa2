/// Monitors at run time whether the rangefinders do what the parameters say.
#pragma once

#include <stdint.h>

#include "firmware/health.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/incidence_watch.hpp"

namespace whisker::perception {

/// Judges all beams together. The rate of contradictions is a mean over the path, with a weight that falls to
/// 1/e in 4 m. The path counts in steps of 20 mm, and a step has at most one contradiction, so that a robot
/// that stands before something that moves counts no more than one.
class RangeMonitor {
 public:
  void configure(const Params& params) noexcept;
  void reset() noexcept;

  /// The body is here.
  void move_to(Vec at) noexcept;
  /// An echo came from ground that earlier readings showed empty. `approaches`: its source comes nearer than
  /// a wall at rest can. Rare in a static world even where walls vanish, so that it counts twice.
  void contradict(bool approaches) noexcept;
  /// Readings of all beams: see IncidenceWatch::add().
  void see(const Pose& from, const SeenRange (&seen)[hal::kBeams],
           const Mount (&mounts)[hal::kBeams]) noexcept {
    incidence_.add(from, seen, mounts);
  }
  /// The largest shares of all beams, 2^-16. Call once per tick, after the others.
  void judge(uint16_t phantoms, uint16_t false_clears) noexcept;

  const RangeTrust& trust() const noexcept { return trust_; }
  /// The body must be slow. Phantoms block ground and clear none, so that they are warned about only.
  bool slows() const noexcept { return contradicted() || trust_.false_clears >= kManyFalseClears; }
  /// Contradictions are frequent.
  bool contradicted() const noexcept { return trust_.contradictions >= doubtful_rate_; }

 private:
  static constexpr uint16_t kManyFalseClears = 13107;
  IncidenceWatch incidence_;
  RangeTrust trust_;
  Vec step_from_;
  uint8_t counted_ = 0;  // contradictions in this step
  uint16_t doubtful_rate_ = 0;
};

}  // namespace whisker::perception
