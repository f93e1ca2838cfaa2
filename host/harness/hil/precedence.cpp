#include "host/harness/hil/precedence.hpp"

#include <cerrno>
#include <cstring>

#include <sched.h>

namespace whisker::hil {

std::string take_precedence() {
  constexpr int kPriority = 10;  // above ordinary processes, below the kernel's own threads
  sched_param how{};
  how.sched_priority = kPriority;
  return sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &how) == 0 ? "" : std::strerror(errno);
}

}  // namespace whisker::hil
