/// Watches the true course of the body.
#pragma once

#include "host/harness/scenario/scenario.hpp"

namespace whisker::hunt {

class Judge {
 public:
  /// The scenario must outlive it. The body stands at its start.
  explicit Judge(const Scenario& scenario);
  /// In order of time; between two calls, the body drives along about one arc.
  void see(const sim::Pose& pose, double t_s);

  /// The body has overlapped an obstacle, by more than the arc may err.
  bool touched() const { return touched_; }
  /// Smallest gap between body and obstacle so far, m.
  double gap_m() const { return least_m_; }
  /// The same, less the margin that the guard keeps or the start had, in radii: below 0, it came nearer.
  double closeness() const { return (least_m_ - margin_m_) / radius_m_; }
  /// The body has neither moved nor turned for half a minute.
  bool rests(double t_s) const;

 private:
  void look(sim::Vec2 at, double slack_m);
  void note_rest(const sim::Pose& pose, double t_s);

  const Scenario& scenario_;
  double radius_m_;
  double margin_m_ = 0;
  double least_m_ = 0;
  double last_gap_m_ = 0;  // at most the gap at the last place looked at
  sim::Vec2 last_;
  sim::Pose before_;
  sim::Pose rest_;
  double rests_since_s_ = 0;
  bool touched_ = false;
};

}  // namespace whisker::hunt
