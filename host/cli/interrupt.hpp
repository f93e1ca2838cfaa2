#pragma once

#include <signal.h>

namespace whisker::cli {

/// During its lifetime, SIGINT and SIGTERM are only recorded. At most one object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool noted() const;  ///< a signal was received

 private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
};

}  // namespace whisker::cli
