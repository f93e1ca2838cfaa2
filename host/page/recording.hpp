/// What a page wants to know of a run while it goes on.
#pragma once

#include <cstddef>
#include <vector>

#include "host/page/film.hpp"
#include "host/run/runner.hpp"

namespace whisker::page {

class Recording {
 public:
  /// The parameters of the robot that will be watched.
  explicit Recording(const Params& params);

  /// For RunOptions::watch.
  void add(const Moment& moment);

  const std::vector<TickRecord>& records() const { return records_; }
  const std::vector<Health>& health() const { return health_; }  ///< one for each record
  const Film& film() const { return film_; }                     ///< a frame every 50 ms

 private:
  std::size_t ticks_a_frame_;
  std::vector<TickRecord> records_;
  std::vector<Health> health_;
  Film film_;
};

}  // namespace whisker::page
