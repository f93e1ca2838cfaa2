/// The thesis's search for an exit on both sides of the blocked target direction: one sweep to each side; the
/// smaller turn wins.
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/side.hpp"
#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {

class FollowSideSearch {
 public:
  /// `blocked` is the target direction.
  void begin(Angle blocked, Side first) noexcept;
  /// Searches only this side.
  void begin_on(Angle blocked, Side only) noexcept;

  /// Turns and evaluates; the body must stand. True: finished.
  bool step(const View& view, Twist& twist) noexcept;

  /// After the search: whether there is an exit, its side and its heading.
  bool found() const noexcept { return exit_[0].free || exit_[1].free; }
  Side side() const noexcept { return best_; }
  Angle heading() const noexcept { return exit(best_).heading; }

 private:
  struct Exit {
    Angle heading;     // of the first free path
    int16_t turn = 0;  // to it, degrees
    int16_t view = 0;  // to the first far view, degrees; 0: none
    bool free = false;
    bool swept = false;
  };
  Exit& exit(Side s) noexcept { return exit_[s == Side::left ? 1 : 0]; }
  const Exit& exit(Side s) const noexcept { return exit_[s == Side::left ? 1 : 0]; }
  static int32_t cost(const Exit& e) noexcept;
  void judge(const View& view, int32_t swept) noexcept;

  Exit exit_[2];
  Angle blocked_;
  Side now_ = Side::left;
  Side best_ = Side::left;
  int32_t candidate_ = 1;
};

}  // namespace whisker::planning
