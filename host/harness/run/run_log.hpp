/// The record of a run. Whatever shows, replays or sums up a run reads its log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "host/harness/run/film.hpp"
#include "host/harness/run/map_film.hpp"
#include "host/harness/run/map_picture.hpp"
#include "host/harness/run/planners.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// What is known before the first tick.
struct RunSetting {
  Scenario scenario;
  std::optional<PlannerKind> planner = std::nullopt;  ///< none: unknown
  std::uint64_t seed = 0;                             ///< of the noise
  bool inside = true;                                 ///< as TickRecord::inside of all its ticks
};

/// Level of detail.
enum class Detail {
  full,    ///< every tick
  coarse,  ///< five ticks a second and the last one, so that a page holds many runs
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

class RunLog {
 public:
  explicit RunLog(RunSetting setting, Detail detail = Detail::full);

  /// Adds each tick of a run with these options, before their own `watch`. The log must outlive the run.
  void watch(RunOptions& options);
  /// As RunOptions::watch calls it.
  void add(const Moment& moment);
  /// The planner's map as it is from the tick on that is added next.
  void note(const MapPicture& map);
  /// After the last tick.
  void end(RunResult result);
  /// Moves the ticks so far out; the log continues after them.
  Ticks take() { return std::exchange(ticks_, {}); }

  RunSetting& setting() { return setting_; }
  const RunSetting& setting() const { return setting_; }
  Detail detail() const { return detail_; }
  const Ticks& ticks() const { return ticks_; }
  /// Undecided before end().
  const RunResult& result() const { return result_; }
  /// The last one; none: the planner has no map.
  const std::optional<MapPicture>& map() const { return map_; }

 private:
  void keep(const TickRecord& record, const Health& health);

  RunSetting setting_;
  Detail detail_;
  RunResult result_;
  std::size_t every_;  // one of this number of ticks is kept
  std::size_t kept_a_frame_;
  std::size_t count_ = 0;  // ticks
  std::size_t kept_ = 0;
  std::optional<std::pair<TickRecord, Health>> last_;  // not kept so far
  Film film_;
  MapWatch map_watch_;
  MapFilm map_film_;
  std::optional<MapPicture> map_;
  Ticks ticks_;
};

}  // namespace whisker
