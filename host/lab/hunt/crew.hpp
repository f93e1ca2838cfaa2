/// Runs jobs in processes of their own, so that a job that dies is a result like another.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace whisker::hunt {

using Say = std::function<void(std::string_view)>;
/// What it says reaches the caller even if it dies later.
using Job = std::function<void(const Say&)>;

struct Ended {
  std::uint64_t id = 0;
  std::string text;   ///< what the job said
  std::string death;  ///< "" of a job that returned, "signal 8", or the text of its exception
};

class Crew {
 public:
  Crew() = default;
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void start(std::uint64_t id, const Job& job);
  std::size_t busy() const { return hands_.size(); }
  /// The jobs that ended, after at most a tenth of a second.
  std::vector<Ended> wait();

 private:
  struct Hand {
    Ended ended;
    pid_t process;
    int pipe;
  };
  std::vector<Hand> hands_;
};

/// One job, to its end.
Ended isolated(const Job& job);

}  // namespace whisker::hunt
