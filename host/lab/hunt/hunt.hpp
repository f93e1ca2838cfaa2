/// Draws cases, drives them in processes of their own, and shrinks what breaks the promise.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "host/lab/hunt/rows.hpp"

namespace whisker::hunt {

struct Progress {
  std::uint64_t cases = 0, findings = 0;
  std::size_t corpus = 0;
  double elapsed_s = 0;
  double processor_s = 0;  ///< of the cases and of shrinking
};

struct Options {
  std::uint64_t seed = 1;   ///< of the first fresh draw
  std::uint64_t count = 0;  ///< fresh draws; 0: until the time is over
  double time_s = 0;        ///< 0: no limit. With one, every second case is a change of one of the corpus
  int jobs = 1;             ///< processes at once
  std::uint64_t shard = 0;  ///< only the seeds first + shard, first + shard + shards, ...
  std::uint64_t shards = 1;
  std::string out;             ///< folder of rows, findings and corpus; empty: none
  std::function<bool()> stop;  ///< true: ends as soon as the running cases have
  /// After each case, and about ten times a second; row: null if none ended.
  std::function<void(const Progress&, const Row* row)> show;
  /// A finding was shrunk, or ends the hunt. `path` without the ending; empty: not written.
  std::function<void(const Row& row, const Progress& progress, const std::string& path)> found;
};

/// The rows of fresh draws depend only on their seeds. Seeds that OUT/rows.csv holds are not driven again.
/// False: a finding among the cases of this hunt.
bool hunt(const Options& options);

}  // namespace whisker::hunt
