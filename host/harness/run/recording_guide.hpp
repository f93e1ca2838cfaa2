#pragma once

#include "firmware/planning/global/wavefront_planner.hpp"
#include "host/harness/run/guidance.hpp"

namespace whisker {

/// Forwards all calls to a global planner, and records its advice. It must outlive this object.
class RecordingGuide final : public planning::GlobalPlanner {
 public:
  explicit RecordingGuide(planning::WavefrontPlanner& guide) : guide_(guide) {}

  void start(const planning::View& view, const planning::Goal& goal) noexcept override {
    started_ = true;
    said_ = Guidance::none;
    goal_ = goal.at;
    body_ = view.pose.at;
    guide_.start(view, goal);
  }
  void move_goal(Vec at) noexcept override {
    goal_ = at;
    guide_.move_goal(at);
  }
  void observe(const planning::View& view) noexcept override {
    body_ = view.pose.at;
    guide_.observe(view);
  }
  void ponder(const planning::View& view) noexcept override { guide_.ponder(view); }
  Advice advise(const planning::View& view, Length distance, Vec& place) noexcept override {
    const Advice advice = guide_.advise(view, distance, place);
    way_ = view.pose.at + place;
    said_ = guidance(advice);
    return advice;
  }
  bool refuse(const planning::View& view) noexcept override {
    const bool goes_on = guide_.refuse(view);
    said_ = goes_on ? Guidance::wait : Guidance::none;
    return goes_on;
  }
  bool knows_no_way() const noexcept override { return guide_.knows_no_way(); }
  void pass() noexcept override { guide_.pass(); }
  bool doubt() noexcept override { return guide_.doubt(); }

  /// Before its first start, its map is no map.
  bool started() const { return started_; }
  /// Its last advice. It is asked in free space only, and the advice ends with its final refusal.
  Guidance said() const { return said_; }
  /// The way point, in the frame of the estimate; only if has_place().
  Vec way() const { return way_; }
  Vec body() const { return body_; }
  Vec goal() const { return goal_; }
  const planning::WavefrontPlanner& inside() const { return guide_; }

 private:
  Guidance guidance(Advice advice) const {
    switch (advice) {
      case Advice::none:
      case Advice::no_way: return Guidance::none;
      case Advice::place: return way_ == goal_ ? Guidance::goal : Guidance::place;
      case Advice::wait: return Guidance::wait;
    }
    return Guidance::unknown;
  }

  planning::WavefrontPlanner& guide_;
  bool started_ = false;
  Guidance said_ = Guidance::none;
  Vec way_;
  Vec body_;
  Vec goal_;
};

}  // namespace whisker
