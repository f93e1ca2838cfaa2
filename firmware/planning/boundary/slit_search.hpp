/// Looks for narrow gaps in a boundary, and remembers the last ones.
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/behaviours.hpp"
#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/planner.hpp"

namespace whisker::planning {

/// A slit is a thin clear path with something on both sides. GapPassage finds out whether the body fits.
class SlitSearch {
 public:
  /// The behaviours must outlive it.
  explicit SlitSearch(const Behaviours& behaviours) noexcept : behaviours_(behaviours) {}

  void reset() noexcept;
  /// A loop around an obstacle begins.
  void begin_loop() noexcept { expected_ = false; }
  /// Remembers a slit at this heading from the body, if there is one and it may be tried from here.
  void look(const View& view, Angle ahead) noexcept;
  /// The same straight ahead, and at some headings on the side of the wall; not more often than every 20 mm.
  void look_on_boundary(const View& view, Side wall) noexcept;
  /// There is a slit that was not tried.
  bool known() const noexcept { return known_ != 0; }
  /// The body is near the place from which a slit was seen, near enough to try it.
  bool at_hand(const View& view) const noexcept { return known() && within(view, kAtHand) != 0; }
  /// The loop is closed, but a slit may lie on the next part of the boundary: a metre and a half where one is
  /// known, 0.6 m where none is. Once per tick from then on.
  bool expected(const View& view) noexcept;
  bool expects() const noexcept { return expected_; }
  /// At the end of a loop: forgets the slits that lie here.
  void end_loop(const View& view) noexcept;
  /// A place in the slit at hand, and the heading there.
  const Pose& next(const View& view) const noexcept { return slits_[index_at_hand(view)]; }
  /// The slit at hand lies in a wall: its sides block paths far beside it, too.
  bool next_in_wall(const View& view) const noexcept { return (in_wall_ >> index_at_hand(view) & 1U) != 0; }
  /// As next(). Forgets it.
  Pose take(const View& view) noexcept;
  /// The slit that was taken last lies within 0.3 m of this place.
  bool taken_near(Vec at) const noexcept;
  /// The slit that was taken last was tried in vain: none within 80 mm of the last three such slits is tried.
  /// After six such attempts in a mission, there are no slits.
  void end_attempt() noexcept;

 private:
  int index_at_hand(const View& view) const noexcept;
  bool tried(Vec at) const noexcept;
  /// The slits that were seen from places within this distance, one bit each.
  uint8_t within(const View& view, Length reference) const noexcept;
  static constexpr Length kAtHand = Length::from_raw(200000);  // for the reference body
  static constexpr int kKept = 4;
  static constexpr int kAttempts = 6;
  static constexpr int kKeptTried = 3;

  const Behaviours& behaviours_;
  uint8_t known_ = 0;    // one bit for each slit
  uint8_t in_wall_ = 0;  // the same
  int8_t newest_ = 0;
  int8_t attempts_ = 0;  // in vain
  bool expected_ = false;
  Pose slits_[kKept];
  Vec tried_[kKeptTried];    // slits
  Vec taken_;                // the slit that was taken last
  int32_t looked_mm_ = 0;    // travel at the last look on the boundary
  int32_t expected_mm_ = 0;  // travel up to which it is expected
};

}  // namespace whisker::planning
