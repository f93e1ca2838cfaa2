/// The exit statuses of the whisker command.
#pragma once

#include <stdexcept>

#include "host/harness/run/record.hpp"

namespace whisker::cli {

enum Exit : int {
  kReached = 0,
  kFailure = 1,   ///< anything else: a full disk, a bug
  kBadInput = 2,  ///< a wrong file, a wrong option
  kUnreachable = 3,
  kGaveUp = 4,
  kContact = 5,
  kFault = 6,
  kOffGoal = 7,
  kInterrupted = 130,  ///< as a shell reports SIGINT
};

/// Invalid usage; what() is the reason in one line.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Ctrl-C or SIGTERM ended the command; what(), which may be empty, follows "interrupted": " after 3 of 8
/// missions".
class Interrupted : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr int exit_status(Verdict verdict) {
  switch (verdict) {
    case Verdict::reached: return kReached;
    case Verdict::off_goal: return kOffGoal;
    case Verdict::unreachable: return kUnreachable;
    case Verdict::gave_up: return kGaveUp;
    case Verdict::contact: return kContact;
    case Verdict::fault: return kFault;
  }
  return kFailure;
}

}  // namespace whisker::cli
