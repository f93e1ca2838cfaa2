#pragma once

#include "firmware/planning/planner.hpp"

namespace whisker {

/// Forwards all calls to a planner, and records the view passed to it. The planner must outlive it.
class RecordingPlanner final : public planning::Planner {
 public:
  explicit RecordingPlanner(planning::Planner& planner) : planner_(planner) {}
  void set_goal(const planning::Goal& goal) noexcept override { planner_.set_goal(goal); }
  void move_goal(Vec at) noexcept override { planner_.move_goal(at); }
  void cancel() noexcept override { planner_.cancel(); }
  planning::Decision step(const planning::View& view) noexcept override {
    view_ = view;
    return planner_.step(view);
  }
  void ponder(const planning::View& view) noexcept override { planner_.ponder(view); }
  /// The view of the last step.
  const planning::View& view() const { return view_; }
  /// Null before the first step.
  const perception::LocalGrid* local_grid() const { return view_.local_grid; }

 private:
  planning::Planner& planner_;
  planning::View view_;
};

}  // namespace whisker
