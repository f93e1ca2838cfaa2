/// What a page wants to know of a run while it goes on.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "host/page/film.hpp"
#include "host/page/map_film.hpp"
#include "host/run/runner.hpp"

namespace whisker::page {

/// How much of a run is kept.
enum class Detail {
  full,    ///< every tick, as in the trace
  coarse,  ///< five ticks a second and the last one, to a millimetre: so that a page has room for many runs
};

/// Ticks one after the other.
struct Ticks {
  std::vector<TickRecord> records;
  std::vector<Health> health;  ///< one for each record
  Frames frames;  ///< of the local grid, one every 50 ms (coarse: 1 s) where there is a local grid
  MapFrames map;  ///< of the map, where there is one: see MapWatch

  /// The ticks of `more` from the one with this index among them; its first is the run's tick `first`.
  void append(const Ticks& more, std::size_t index, std::size_t first);
};

class Recording {
 public:
  /// The parameters of the robot that will be watched.
  explicit Recording(const Params& params, Detail detail = Detail::full);

  /// For RunOptions::watch.
  void add(const Moment& moment);
  /// Coarse: keeps the last tick, too. After the run.
  void end();

  const Ticks& ticks() const { return ticks_; }
  /// The same, which the recording then no longer holds; it goes on behind them.
  Ticks take() { return std::exchange(ticks_, {}); }

 private:
  void keep(const TickRecord& record, const Health& health);

  std::size_t every_;  // of so many ticks one is kept
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
