#pragma once

#include <algorithm>
#include <cstdint>

namespace whisker::hil {

/// Decides when a set without an answer is repeated: after kSpare times the usual answer time, and the wait
/// doubles with each repetition. It stays doubled until a set that was sent once is answered, because the
/// answer to a repeated set cannot be assigned to one of its copies.
class Resend {
 public:
  static constexpr std::uint64_t kSpare = 3;
  static constexpr std::uint64_t kMost_us = 640000;

  /// least_us: the initial and shortest wait; at most kMost_us.
  explicit Resend(std::uint64_t least_us) : least_us_(least_us), wait_us_(least_us) {}

  void sent(std::uint64_t now_us) {
    first_us_ = last_us_ = now_us;
    copies_ = 1;
  }
  bool due(std::uint64_t now_us) const { return now_us - last_us_ >= wait_us_; }
  void sent_again(std::uint64_t now_us) {
    last_us_ = now_us;
    ++copies_;
    wait_us_ = std::min(2 * wait_us_, kMost_us);
  }
  void answered(std::uint64_t now_us) {
    if (copies_ != 1) return;
    const std::uint64_t took_us = now_us - first_us_;
    usual_us_ = known_ ? (7 * usual_us_ + took_us) / 8 : took_us;
    known_ = true;
    wait_us_ = std::clamp(kSpare * usual_us_, least_us_, kMost_us);
  }
  std::uint64_t wait_us() const { return wait_us_; }

 private:
  const std::uint64_t least_us_;
  std::uint64_t wait_us_;
  std::uint64_t usual_us_ = 0;  // answer time of sets that were sent once, smoothed
  std::uint64_t first_us_ = 0;
  std::uint64_t last_us_ = 0;
  int copies_ = 0;
  bool known_ = false;
};

}  // namespace whisker::hil
