/// Counts refusals of a part of the board.
#pragma once

#include <stdint.h>

namespace whisker::safety {

/// Counts refusals that are close to one another. It tolerates an occasional refusal, but not refusals that
/// block a robot, whether in a row or every second time.
class Refusals {
 public:
  void reset() noexcept { *this = Refusals{}; }
  /// True: there are too many.
  bool refuse(int32_t most) noexcept {
    accepted_ = 0;
    if (count_ < most) ++count_;
    return count_ >= most;
  }
  /// Ten accepted calls in a row restart the count.
  void accept() noexcept {
    if (accepted_ < kForgiven && ++accepted_ == kForgiven) count_ = 0;
  }
  /// The last call was refused.
  bool refused() const noexcept { return accepted_ == 0 && count_ > 0; }

 private:
  static constexpr int8_t kForgiven = 10;
  int16_t count_ = 0;
  int8_t accepted_ = 0;  // in a row
};

}  // namespace whisker::safety
