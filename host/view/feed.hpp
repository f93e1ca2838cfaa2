/// A run that goes on, told to any number of watchers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "host/page/page.hpp"
#include "host/page/recording.hpp"
#include "host/report/encounters.hpp"

namespace whisker::view {

/// How far a watcher has come. As new, it is told everything.
struct Place {
  std::string run;          ///< the run's name, another one each time that a run begins
  std::size_t next = 0;     ///< tick
  std::uint64_t notes = 0;  ///< what else has been told
};

/// One thread drives and tells; others listen, each at its own pace. What has been told is kept once, whoever
/// listens. A call of the driver's takes a short time that does not depend on them.
class Feed {
 public:
  /// A run begins, or begins anew: nothing of the one before it is left. Before everything else.
  void begin(const page::Setting& setting);
  /// For RunOptions::watch.
  void add(const Moment& moment);
  /// What the run waits for, for a person; "" for nothing.
  void say(const std::string& words);
  void end(const RunResult& result);
  /// Nothing more will come, whatever the run was about to do.
  void close();

  /// What has come since this place, as one JSON object, and moves the place behind it; none if nothing has.
  /// Of more than some thousand ticks the next news has the rest. docs/replay.md has the format.
  std::optional<std::string> news(Place& place) const;
  /// All is told, and nothing more will come.
  bool over(const Place& place) const;

 private:
  bool told(const Place& place) const;

  mutable std::mutex mutex_;
  std::string run_;
  std::string setting_;
  std::optional<page::Recording> last_;                    // less than a whole one
  std::vector<std::shared_ptr<const page::Ticks>> whole_;  // never change
  std::size_t count_ = 0;                                  // ticks
  report::EncounterFinder edges_;
  std::string words_;
  std::string result_;  // "" before the end
  bool closed_ = false;
  std::uint64_t notes_ = 0;  // grows with what is no tick
};

}  // namespace whisker::view
