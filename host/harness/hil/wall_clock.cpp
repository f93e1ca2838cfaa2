#include "host/harness/hil/wall_clock.hpp"

#include <ctime>

#include <poll.h>

namespace whisker::hil {

std::uint64_t WallClock::now_us() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::uint64_t>(t.tv_sec) * 1000000 + static_cast<std::uint64_t>(t.tv_nsec) / 1000;
}

void WallClock::wait(std::uint64_t most_us) {
  pollfd waiting{descriptor_(), POLLIN, 0};
  const timespec most{static_cast<time_t>(most_us / 1000000), static_cast<long>(most_us % 1000000) * 1000};
  ppoll(&waiting, waiting.fd >= 0 ? 1 : 0, &most, nullptr);
  // poll() returns at once for a failed descriptor: without this sleep the caller would spin.
  if ((waiting.revents & ~POLLIN) != 0) ppoll(nullptr, 0, &most, nullptr);
}

}  // namespace whisker::hil
