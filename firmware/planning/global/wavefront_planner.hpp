/// Global planner on the grid map: it plans a little in each tick and returns the next way point.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"
#include "firmware/planning/closest_approach.hpp"
#include "firmware/planning/global/global_planner.hpp"
#include "firmware/planning/global/grid_map.hpp"
#include "firmware/planning/global/wavefront.hpp"

namespace whisker::planning {

class WavefrontPlanner final : public GlobalPlanner {
 public:
  /// As GridMap. The parameters must outlive it as well.
  WavefrontPlanner(const Params& params, const GridShape& shape, GridWord* storage) noexcept
      : params_(params), map_(shape, storage) {}

  void start(const View& view, const Goal& goal) noexcept override;
  void move_goal(Vec at) noexcept override;
  void observe(const View& view) noexcept override;
  void ponder(const View& view) noexcept override;
  Advice advise(const View& view, Length distance, Vec& place) noexcept override;
  bool refuse(const View& view) noexcept override;
  bool knows_no_way() const noexcept override { return no_way_ || last_try_; }
  void pass() noexcept override;
  bool doubt() noexcept override;

  const GridMap& map() const noexcept { return map_; }
  const Wavefront& wavefront() const noexcept { return wavefront_; }
  /// No plan is in progress: wavefront() is complete.
  bool planned() const noexcept { return stage_ == Stage::idle && !waits_; }

 private:
  /// Beside the wavefronts, `look` examines the way that one has found.
  enum class Stage : uint8_t { idle, copy, ready, strict, passing, look };
  struct VirtualObstacle {
    Vec at;
    int32_t until_mm = 0;
  };

  void begin(Stage stage, const View& view) noexcept;
  /// A wavefront is under way.
  bool floods() const noexcept { return stage_ == Stage::strict || stage_ == Stage::passing; }
  /// Gives the plan under way up.
  void drop_plan() noexcept;
  void flood(const View& view) noexcept;
  void prepare(const View& view) noexcept;
  void copy(const View& view) noexcept;
  void begin_plan(const View& view) noexcept;
  void end_wavefront(const View& view) noexcept;
  bool still_open(const View& view) const noexcept;
  void find_way(const View& view) noexcept;
  void take_way(const View& view) noexcept;
  void look_on(const View& view) noexcept;
  void end_plan() noexcept;
  Length dearer(Vec from, Vec to) const noexcept;
  int32_t accepted(const View& view) const noexcept;
  int32_t levels(Length l) const noexcept;
  bool straight(const View& view) const noexcept;
  bool sees(const View& view, Vec to) const noexcept;
  bool undecided(const View& view) const noexcept;
  void place_virtual_obstacles() noexcept;
  void place_contacts(const View& view) noexcept;
  bool spent() const noexcept;
  void hand_over() noexcept;
  void bar(Vec at) noexcept;
  Length reference(Length l) const noexcept { return for_body(params_, l); }
  int32_t mm(Length l) const noexcept { return reference(l).raw() / 1000; }

  const Params& params_;
  Goal goal_;
  Stage stage_ = Stage::idle;
  Vec way_;  // the way point
  bool has_way_ = false;
  bool no_way_ = false;    // result of the last plan
  bool shut_ = false;      // the same, except for a path around outside the window
  bool last_try_ = false;  // loops were closed, and the body has not come nearer to the goal since
  bool waits_ = false;     // for the next plan
  bool active_ = true;
  int8_t refusals_ = 0;
  int8_t attempts_ = 0;  // finished attempts with the map
  uint8_t kept_ = 0;     // plans in a row for which the wavefront was kept
  bool first_ = false;   // no cell of the way has been looked at
  bool detour_ = false;  // without suspect cells, the last way is much longer than the straight line
  int32_t strict_ = 0;   // levels to the body if suspect cells block
  int32_t ticks_ = 0;    // since the current plan started
  Cell on_;              // of the way, looked at last
  Vec seen_;             // the farthest place on it that the body sees: the way point to be
  ClosestApproach best_;
  int32_t improved_mm_ = 0;  // travel at the last improvement
  uint32_t started_um_ = 0;  // View::travelled_um at the start
  int32_t travel_mm_ = 0;
  int16_t more_ = 0;  // cells of the way to look at, or rows to copy
  int8_t newest_ = 0;
  static constexpr int kVirtualObstacles = 4;
  VirtualObstacle virtual_obstacles_[kVirtualObstacles];
  GridMap map_;
  Wavefront wavefront_;
};

}  // namespace whisker::planning
