/// Driving through a guard node on the bus, as its operator.
#pragma once

#include <functional>

#include "host/cli/bench_bus.hpp"
#include "host/guard/operator.hpp"

namespace whisker::cli {

struct HandDrive {
  guard::Operator& hand;
  std::function<bool(double t_s)> done;  ///< the hand has no more to ask
  double vouched_m = 0;
  double for_s = 600;
  bool shown = false;  ///< a line on the terminal says what is granted
  bool json = false;
};

/// Returns the exit status. Throws bench::NoAnswer if the guard node has another table, another operator
/// sends, or the robot may not drive for longer than the time-out once it has driven.
int operate(BenchBus& bus, const BenchChoice& choice, const HandDrive& drive);

}  // namespace whisker::cli
