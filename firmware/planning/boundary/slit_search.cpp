#include "firmware/planning/boundary/slit_search.hpp"

#include "firmware/planning/boundary/gap_passage.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body.
constexpr Length kEvery = 20_mm;
constexpr Length kHalfWidth = 45_mm;
constexpr int32_t kUnknown = 2;   // cells
constexpr Length kJamb = 110_mm;  // from the middle of a slit to the paths that its sides block
constexpr Length kAtHand = 200_mm;
constexpr Length kHere = 500_mm;
constexpr Length kExpected = 1500_mm;  // of travel

}  // namespace

void SlitSearch::reset() noexcept {
  known_ = expected_ = false;
  looked_mm_ = 0;
}

void SlitSearch::search(const View& view, Angle ahead) noexcept {
  const Params& params = behaviours_.params;
  // Where beams must sweep past a cell to clear it, the passage cannot clear a lane.
  if (view.local_grid->reach().past != Angle{}) return;
  const Length length = for_body(params, GapPassage::kSeenFrom);
  const auto path = [&](Length left) {
    const Vec from = view.pose.at + polar(ahead + 90_deg, for_body(params, left));
    return view.local_grid->along(from, ahead, length, for_body(params, kHalfWidth), 1);
  };
  const perception::Obstacles middle = path(Length{});
  if (middle.suspect != 0 || middle.unknown > kUnknown) return;
  const perception::Obstacles left = path(kJamb), right = path(-kJamb);
  if (left.suspect + left.unknown == 0 || right.suspect + right.unknown == 0) return;
  if (left.suspect + right.suspect == 0) return;
  slit_ = {view.pose.at + polar(ahead, length), ahead};
  known_ = true;
}

void SlitSearch::look_beside(const View& view, Side wall) noexcept {
  const int32_t travel_mm = behaviours_.progress.travel_mm();
  if (travel_mm - looked_mm_ <= behaviours_.mm(kEvery)) return;
  looked_mm_ = travel_mm;
  for (int32_t degrees = 60; degrees <= 105; degrees += 15) {
    look(view, view.pose.heading + 1_deg * (degrees * sign(wall)));
  }
}

bool SlitSearch::within(const View& view, Length reference) const noexcept {
  const Vec from = slit_.at - polar(slit_.heading, for_body(behaviours_.params, GapPassage::kSeenFrom));
  return !farther(view.pose.at - from, for_body(behaviours_.params, reference));
}

bool SlitSearch::at_hand(const View& view) const noexcept { return known() && within(view, kAtHand); }

bool SlitSearch::expected(const View& view) noexcept {
  const int32_t travel_mm = behaviours_.progress.travel_mm();
  if (!expected_) {
    if (!known() || !within(view, kHere)) return false;
    expected_mm_ = travel_mm + behaviours_.mm(kExpected);
  }
  expected_ = known() && travel_mm < expected_mm_;
  return expected_;
}

void SlitSearch::end_loop(const View& view) noexcept {
  if (known() && within(view, kHere)) known_ = false;
}

Pose SlitSearch::take() noexcept {
  known_ = expected_ = false;
  return slit_;
}

}  // namespace whisker::planning
