/// A running run, published to any number of watchers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/harness/run/run_log.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/report/encounters.hpp"

namespace whisker::view {

/// Position of a watcher. A new one receives everything.
struct Place {
  std::string run;          ///< the run's name, a new one whenever a run begins
  std::size_t next = 0;     ///< tick
  std::uint64_t notes = 0;  ///< number of other events received
};

/// One thread drives and publishes; others read, each at its own sync_mode. Published data is stored once for
/// all readers. The calls of the driving thread take a short time that does not depend on the readers.
class Feed {
 public:
  /// A run begins, or begins again: data of the one before is discarded. Call it first.
  void begin(const RunSetting& setting);
  /// For RunOptions::watch.
  void add(const Moment& moment);
  /// For people: the item that the run waits for; "" if none.
  void say(const std::string& words);
  void end(const RunResult& result);
  /// No more data follows.
  void close();

  /// The news since this position as one JSON object; advances the position. None if there is nothing new.
  /// Beyond some thousand ticks, the next call returns the rest. docs/pages.md describes the format.
  std::optional<std::string> news(Place& place) const;
  /// Everything was read, and no more data follows.
  bool over(const Place& place) const;

 private:
  bool reported(const Place& place) const;

  mutable std::mutex mutex_;
  std::string run_;
  std::string setting_;
  std::optional<RunLog> last_;                       // less than a complete one
  std::vector<std::shared_ptr<const Ticks>> whole_;  // immutable
  std::size_t count_ = 0;                            // ticks
  report::EncounterFinder edges_;
  std::string words_;
  std::string result_;  // "" before the end
  bool closed_ = false;
  std::uint64_t notes_ = 0;  // counts events that are not ticks
};

}  // namespace whisker::view
