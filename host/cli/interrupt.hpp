#pragma once

#include <signal.h>

namespace whisker::cli {

/// While it lives, SIGINT and SIGTERM are only noted. At most one at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool noted() const;  ///< one has come

 private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
};

}  // namespace whisker::cli
