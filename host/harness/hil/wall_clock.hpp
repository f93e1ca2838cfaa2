#pragma once

#include <functional>

#include "host/harness/hil/clock.hpp"

namespace whisker::hil {

/// Time of this computer. Waiting ends early when the descriptor is readable; descriptor() may return -1.
class WallClock final : public Clock {
 public:
  explicit WallClock(std::function<int()> descriptor) : descriptor_(std::move(descriptor)) {}
  std::uint64_t now_us() override;
  void wait(std::uint64_t most_us) override;

 private:
  std::function<int()> descriptor_;
};

}  // namespace whisker::hil
