/// The planner of the thesis: fuzzy steering in free space, a probe before every step, and deadlock
/// prevention by following the boundary of the obstacle that blocks the target.
///
///   idle -> facing -> looking -> steering -> probing -> stepping -> facing ...        (t = 0)
///                        |                      ^
///                        +-> searching ---------+---> following -> facing ...          (t > 0)
///
/// Source: "Simulation Implementation of Path Planning Algorithm Based on Fuzzy Control"; docs/navigation.md
/// separates the thesis from reconstructions. It is the baseline: it can enter the same trap again until its
/// budget ends.
#pragma once

#include <stdint.h>

#include "firmware/fuzzy/engine.hpp"
#include "firmware/params.hpp"
#include "firmware/planning/arrows.hpp"
#include "firmware/planning/goal_planner.hpp"
#include "firmware/planning/scan_behaviour.hpp"
#include "firmware/planning/thesis/step_probe.hpp"
#include "firmware/planning/thesis/surroundings.hpp"

namespace whisker::planning {

class ThesisPlanner final : public GoalPlanner {
 public:
  /// The table and the parameters must outlive the planner; the parameters must pass check().
  ThesisPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept;

 private:
  enum class Phase : uint8_t {
    at_position,  // at a new position: check the goal, then face it
    face,         // turning to the target, then scanning along it
    probe,        // turning to a candidate heading, then scanning along it
    search_left,  // follow-side search: turning away to one side by delta
    search_right,
    move,        // driving the step
    scan,        // the guard cut the step: turning beams onto unseen cells of its path
    face_again,  // back to the heading of the step
  };
  static constexpr Arrow<Phase> kArrows[] = {
      {Phase::at_position, Phase::face},
      {Phase::face, Phase::probe},
      {Phase::face, Phase::move},
      {Phase::face, Phase::search_left},
      {Phase::probe, Phase::probe},
      {Phase::probe, Phase::move},
      {Phase::search_left, Phase::search_left},
      {Phase::search_left, Phase::search_right},
      {Phase::search_left, Phase::probe},
      {Phase::search_right, Phase::search_right},
      {Phase::search_right, Phase::probe},
      {Phase::move, Phase::face},
      {Phase::move, Phase::scan},
      {Phase::move, Phase::probe},
      {Phase::scan, Phase::face_again},
      {Phase::face_again, Phase::move},
  };

  void start(const View& view) noexcept override;
  void advance(const View& view) noexcept override;
  void enter(Phase phase) noexcept { follow(kArrows, phase_, phase); }
  void set_pace(const View& view) noexcept;
  bool step_is_free(const View& view) const noexcept;
  bool sees(const View& view) noexcept;
  void arrive_at_position(const View& view) noexcept;
  void end_step(const View& view) noexcept;
  void scan(const View& view) noexcept;
  void choose(const View& view) noexcept;
  void steer(const View& view, Length distance) noexcept;
  void follow_danger(const View& view) noexcept;
  void probe(const View& view) noexcept;
  void search(const View& view) noexcept;
  void take_exit(int32_t side, Why why) noexcept;
  void deflect(Phase phase) noexcept;
  void deflect_or_end() noexcept;
  void turn_to(Angle heading) noexcept;
  void drive(Length length) noexcept;
  Length rest_of_step(const View& view) const noexcept;
  void end(Mode mode, Why why, Outcome outcome) noexcept;
  Angle deflection() const noexcept;

  const Params& params_;
  fuzzy::Engine engine_;
  StepProbe probe_;
  Surroundings surroundings_;  // at this position

  Phase phase_ = Phase::at_position;
  Angle target_;    // direction of the goal from this position
  Angle base_;      // heading from which the deflection counts
  Length planned_;  // step
  Vec left_;        // start of the step
  ScanBehaviour scan_;
  bool scanned_ = false;  // the path of the step, from scanned_at_
  Vec scanned_at_;
  int32_t side_ = 1;         // of the deflection: +1 left, -1 right
  int32_t deflections_ = 0;  // by delta, from base_
  int32_t exit_left_ = 0;    // deflections of the free heading found on the left; 0: none
  int32_t steps_ = 0;
};

}  // namespace whisker::planning
