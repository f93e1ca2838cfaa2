/// Drives through a gap that is hardly wider than the body.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/arrows.hpp"
#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// Measures the two jambs of the gap with the front beam: while the body turns slowly, a reading drops when
/// the edge of the cone meets a jamb. Then it stands in front of the gap, measures again from there, opens a
/// lane through the middle, and creeps along it.
class GapPassage {
 public:
  enum class Result : uint8_t { under_way, through, failed };
  /// A gap is seen from a place this far before it, for the reference body.
  static constexpr Length kSeenFrom = Length::from_raw(150000);

  /// The behaviours must outlive it.
  explicit GapPassage(Behaviours& behaviours) noexcept : behaviours_(behaviours) {}

  /// The gap lies at about this place and leads along this heading. `promised`: only if it is as wide as an
  /// *unreachable* names; so much room needs less precision. Brings the body to rest.
  void begin(const View& view, const Pose& gap, bool promised, Decision& decision) noexcept;
  /// Once per tick after that.
  Result step(const View& view, Decision& decision) noexcept;
  /// Promised gaps of this mission that were none.
  int8_t failures() const noexcept { return failures_; }
  void count_failure() noexcept { ++failures_; }
  void reset() noexcept { failures_ = 0; }
  /// As begin() was told.
  bool promised() const noexcept { return promised_; }
  /// The heading of the body when it began.
  Angle came_along() const noexcept { return came_along_; }

 private:
  enum class Phase : uint8_t {
    brake,  // comes to rest
    face,   // turns towards the gap
    sweep,  // turns slowly to both sides and measures the jambs
    aim,    // turns towards the place in front of the gap
    move,   // drives there
    creep,  // drives along the lane
  };
  static constexpr Arrow<Phase> kArrows[] = {
      {Phase::brake, Phase::face}, {Phase::brake, Phase::aim},   {Phase::face, Phase::creep},
      {Phase::face, Phase::sweep}, {Phase::sweep, Phase::face},  {Phase::sweep, Phase::aim},
      {Phase::aim, Phase::face},   {Phase::aim, Phase::move},    {Phase::move, Phase::brake},
      {Phase::creep, Phase::face}, {Phase::creep, Phase::sweep},
  };

  void enter(Phase phase) noexcept;
  void pause() noexcept;
  Result sweep(const View& view, Decision& decision) noexcept;
  /// Looks for the innermost point of the jamb on this side. True: the beam is past it.
  bool jamb(const View& view) noexcept;
  /// Nearly the width that an *unreachable* names; more for sensors that lose walls.
  Length promised_width(const View& view) const noexcept;
  Result measured(const View& view, Decision& decision) noexcept;
  Result move(const View& view, Decision& decision) noexcept;
  Result creep(const View& view, Decision& decision) noexcept;
  /// Heading on the lane.
  Angle way() const noexcept { return returns_ ? ahead_ + 180_deg : ahead_; }
  Speed pace() const noexcept;
  /// The place on the middle line of the gap at this distance before it.
  Vec before(Length reference) const noexcept;
  /// From the body to the next place from which it measures.
  Vec rest(const View& view) const noexcept;

  Behaviours& behaviours_;
  Phase phase_ = Phase::brake;
  Side side_ = Side::left;  // of the jamb that the sweep looks for
  int8_t sweeps_ = 0;       // to one side each, since the last pair of jambs
  int8_t rounds_ = 0;       // pairs of jambs
  int8_t lanes_ = 0;        // that did not lead through
  int8_t stops_ = 0;        // on the lane
  int8_t moves_ = 0;        // to the place in front of the gap
  bool there_ = false;      // at the place from which the gap was seen
  bool opened_ = false;     // the lane is open
  bool returns_ = false;    // drives back along it
  bool meets_ = false;      // this sweep has met a jamb
  bool doubtful_ = false;   // the last pair of jambs was none
  int8_t failures_ = 0;
  bool promised_ = false;  // a narrow gap is not tried
  uint8_t seen_ = 0;       // jambs, a bit for each side
  Length last_;            // the last reading of this sweep; zero: none
  Vec jambs_[2];           // left, right
  Vec stopped_;            // the last stop on the lane
  Vec at_;                 // the middle of the gap
  Angle ahead_;            // heading through it
  Angle came_along_;
};

}  // namespace whisker::planning
