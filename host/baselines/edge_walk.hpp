/// Boundary following for a body that must not touch: the bug algorithms' "follow the obstacle's boundary".
///
/// Along the wall by the beams while the patch lets it; where that ends, or where the wall may have an
/// opening, it stands, takes the first free heading counted from the wall, and goes on. If there is none, it
/// goes back on its own trail.
#pragma once

#include <cstdint>

#include "firmware/nav/feeler.hpp"
#include "firmware/nav/look.hpp"
#include "firmware/nav/side.hpp"
#include "firmware/nav/stall.hpp"

namespace whisker::baselines {

class EdgeWalk {
 public:
  static constexpr Duration kPatience = milliseconds(500);  ///< see nav::Stall

  /// The parameters must outlive it.
  explicit EdgeWalk(const Params& params) : params_(params) {}

  /// Where the walker is now; once a tick, also while it does not follow an edge.
  void note(const nav::View& view);
  void forget_trail(const nav::View& view);

  /// The wall will be on this side; the way along `blocked` is not free. The caller stops the
  /// body, here and for resume().
  void begin(nav::Side wall, Angle blocked);
  /// The same edge once more, after the body turned away from its `heading` along the wall.
  void resume(const nav::View& view, Angle heading) { feel_from_wall(view, heading); }
  /// Fills in manoeuvre, mode, why and looked. False: there is no way at all.
  bool step(const nav::View& view, nav::Decision& decision);
  /// It drives, as opposed to standing and looking for a way.
  bool drives() const { return phase_ == Phase::walk; }
  nav::Side wall() const { return wall_; }

 private:
  enum class Phase : std::uint8_t { brake, feel, look, turn, walk, retreat };

  void walk(const nav::View& view, nav::Decision& decision);
  bool may_open(const nav::View& view);
  void feel_from_wall(const nav::View& view, Angle heading);
  void feel(const nav::View& view, nav::Decision& decision);
  bool retreat(const nav::View& view, nav::Decision& decision);

  const Params& params_;
  Phase phase_ = Phase::walk;
  nav::Side wall_ = nav::Side::left;
  nav::Feeler feeler_;
  nav::Look look_;
  nav::Feeler::Heading found_;
  nav::Stall stall_;
  Angle course_;

  Vec last_;
  std::int64_t travel_um_ = 0;
  std::int64_t straight_until_um_ = 0;
  std::int64_t felt_um_ = 0;
};

}  // namespace whisker::baselines
