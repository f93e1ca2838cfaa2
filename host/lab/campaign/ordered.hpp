/// Runs independent tasks on several threads and returns their results in order.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "host/lab/campaign/row.hpp"

namespace whisker::campaign {

/// Thrown by a task that was requested to stop.
struct Stopped {};

struct Work {
  std::uint64_t count = 0;
  int jobs = 1;  ///< threads, at least 1
  /// Runs task 0..count-1 on any thread, several at once. May throw Stopped once `stop` is true.
  std::function<Row(std::uint64_t piece, const std::atomic<bool>& stop)> make;
  /// Receives each result in order, on the caller's thread.
  std::function<void(const Row&)> take;
  /// Called on the caller's thread at least every tenth of a second with the number of received results.
  std::function<void(std::uint64_t)> wait;
  std::function<bool()> stop;  ///< true: no new task is started, and running ones are requested to stop
};

/// Returns the number of received results: work.count, or fewer after a stop. If a task throws, the results
/// before it are received first, then its exception is thrown. An exception of take, wait or stop is thrown
/// too. All threads have ended when this function returns.
std::uint64_t do_in_order(const Work& work);

}  // namespace whisker::campaign
