#pragma once

#include "firmware/nav/planner.hpp"

namespace whisker {

/// Passes everything on, and remembers which ground it was shown. The planner must outlive it.
class ShownPlanner final : public nav::Planner {
 public:
  explicit ShownPlanner(nav::Planner& planner) : planner_(planner) {}
  void set_goal(const nav::Goal& goal) noexcept override { planner_.set_goal(goal); }
  void move_goal(Vec at) noexcept override { planner_.move_goal(at); }
  void cancel() noexcept override { planner_.cancel(); }
  nav::Decision step(const nav::View& view) noexcept override {
    patch_ = view.patch;
    return planner_.step(view);
  }
  /// Null before the first step.
  const ground::Patch* patch() const { return patch_; }

 private:
  nav::Planner& planner_;
  const ground::Patch* patch_ = nullptr;
};

}  // namespace whisker
