#include "firmware/planning/boundary/progress_checker.hpp"

namespace whisker::planning {
namespace {

constexpr Length kProgress = 30_mm;
constexpr int16_t kManyPauses = 24;
constexpr int16_t kMostPauses = 1000;

}  // namespace

void ProgressChecker::start(const View& view) noexcept {
  started_um_ = view.travelled_um;
  travel_mm_ = 0;
  place_ = view.pose.at;
  pauses_ = 0;
}

void ProgressChecker::move(const View& view, const Params& params) noexcept {
  travel_mm_ = static_cast<int32_t>((view.travelled_um - started_um_) / 1000);
  if (!farther(view.pose.at - place_, for_body(params, kProgress))) return;
  place_ = view.pose.at;
  pauses_ = 0;
}

bool ProgressChecker::rests() const noexcept { return pauses_ >= kManyPauses; }

Why ProgressChecker::exhausted(Length budget) const noexcept {
  if (travel_mm_ > budget.raw() / 1000) return Why::length_budget;
  return pauses_ > kMostPauses ? Why::no_exit : Why::none;
}

}  // namespace whisker::planning
