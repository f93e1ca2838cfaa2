/// Boundary following for a body that must not touch: the bug algorithms' "follow the obstacle's boundary".
///
/// Along the wall by the beams while the local grid lets it; where that ends, or where the wall may have an
/// opening, it stands, takes the first free heading counted from the wall, and goes on. If there is none, it
/// goes back on its own trail.
#pragma once

#include <cstdint>

#include "firmware/planning/boundary/heading_search.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/boundary/stuck_detector.hpp"
#include "firmware/planning/scan_behaviour.hpp"

namespace whisker::baselines {

class EdgeWalk {
 public:
  static constexpr Duration kPatience = milliseconds(500);  ///< see planning::Stall

  /// The parameters must outlive it.
  explicit EdgeWalk(const Params& params) : params_(params) {}

  /// Where the walker is now; once a tick, also while it does not follow an edge.
  void note(const planning::View& view);
  void forget_trail(const planning::View& view);

  /// The wall will be on this side; the way along `blocked` is not free. The caller stops the
  /// body, here and for resume().
  void begin(planning::Side wall, Angle blocked);
  /// The same edge once more, after the body turned away from its `heading` along the wall.
  void resume(const planning::View& view, Angle heading) { feel_from_wall(view, heading); }
  /// Fills in manoeuvre, mode, why and looked. False: there is no way at all.
  bool step(const planning::View& view, planning::Decision& decision);
  /// It drives, as opposed to standing and looking for a way.
  bool drives() const { return phase_ == Phase::walk; }
  planning::Side wall() const { return wall_; }

 private:
  enum class Phase : std::uint8_t { brake, feel, look, turn, walk, retreat };

  void walk(const planning::View& view, planning::Decision& decision);
  bool may_open(const planning::View& view);
  void feel_from_wall(const planning::View& view, Angle heading);
  void feel(const planning::View& view, planning::Decision& decision);
  bool retreat(const planning::View& view, planning::Decision& decision);

  const Params& params_;
  Phase phase_ = Phase::walk;
  planning::Side wall_ = planning::Side::left;
  planning::HeadingSearch heading_search_;
  planning::ScanBehaviour scan_;
  planning::HeadingSearch::Heading found_;
  planning::StuckDetector stuck_;
  Angle course_;

  Vec last_;
  std::int64_t travel_um_ = 0;
  std::int64_t straight_until_um_ = 0;
  std::int64_t felt_um_ = 0;
};

}  // namespace whisker::baselines
