/// Records the data of a running run for a page.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "host/harness/run/runner.hpp"
#include "host/lab/page/film.hpp"
#include "host/lab/page/map_film.hpp"

namespace whisker::page {

/// Level of detail.
enum class Detail {
  full,    ///< every tick, as in the trace
  coarse,  ///< five ticks a second and the last one, to a millimetre, so that a page holds many runs
};

/// Consecutive ticks.
struct Ticks {
  std::vector<TickRecord> records;
  std::vector<Health> health;  ///< one per record
  Frames frames;               ///< of the local grid, if there is one: every 50 ms (coarse: 1 s)
  MapFrames map;               ///< of the map, if there is one: see MapWatch

  /// The ticks of `more` from the one with this index on; its first is tick `first` of the run.
  void append(const Ticks& more, std::size_t index, std::size_t first);
};

class Recording {
 public:
  /// The parameters of the watched robot.
  explicit Recording(const Params& params, Detail detail = Detail::full);

  /// For RunOptions::watch.
  void add(const Moment& moment);
  /// Coarse: keeps the last tick, too. Call it after the run.
  void end();

  const Ticks& ticks() const { return ticks_; }
  /// Moves the recorded ticks out; the recording continues after them.
  Ticks take() { return std::exchange(ticks_, {}); }

 private:
  void keep(const TickRecord& record, const Health& health);

  std::size_t every_;  // one of this number of ticks is kept
  std::size_t kept_a_frame_;
  std::size_t count_ = 0;  // ticks
  std::size_t kept_ = 0;
  std::optional<std::pair<TickRecord, Health>> last_;  // not kept so far
  Film film_;
  MapWatch map_watch_;
  MapFilm map_film_;
  Ticks ticks_;
};

}  // namespace whisker::page
