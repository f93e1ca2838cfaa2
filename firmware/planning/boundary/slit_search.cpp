#include "firmware/planning/boundary/slit_search.hpp"

#include "firmware/planning/boundary/gap_passage.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body.
constexpr Length kEvery = 20_mm;
constexpr Length kHalfWidth = 45_mm;
constexpr int32_t kUnknown = 2;   // cells
constexpr Length kJamb = 130_mm;  // from the middle of a slit to the paths that its sides block
constexpr Length kWall = 300_mm;  // the same for the sides of a slit in a wall
constexpr Length kSame = 150_mm;  // the distance between two views of one slit
constexpr Length kTried = 80_mm;  // from a slit that was tried
constexpr Length kNear = 300_mm;  // a slit that was taken
constexpr Length kHere = 500_mm;
constexpr Length kExpected = 1500_mm;  // of travel
constexpr Length kPast = 600_mm;       // the same, where no slit is known

}  // namespace

void SlitSearch::reset() noexcept {
  known_ = 0;
  attempts_ = 0;
  expected_ = false;
  looked_mm_ = 0;
}

void SlitSearch::look(const View& view, Angle ahead) noexcept {
  const Params& params = behaviours_.params;
  // Where beams must sweep past a cell to clear it, the passage cannot clear a lane.
  if (view.local_grid->reach().past != Angle{} || attempts_ == kAttempts) return;
  const Length length = for_body(params, GapPassage::kSeenFrom), half_width = for_body(params, kHalfWidth);
  const auto path = [&](Vec from) { return view.local_grid->along(from, ahead, length, half_width, 1); };
  const perception::Obstacles middle = path(view.pose.at);
  if (middle.suspect != 0 || middle.unknown > kUnknown) return;
  const auto blocked = [&](Length left) {
    return path(view.pose.at + polar(ahead + 90_deg, for_body(params, left))).suspect != 0;
  };
  if (!blocked(kJamb) || !blocked(-kJamb)) return;
  const Vec at = view.pose.at + polar(ahead, length);
  if (tried(at)) return;
  const bool same =
      (known_ >> newest_ & 1U) != 0 && !farther(at - slits_[newest_].at, for_body(params, kSame));
  if (!same) newest_ = static_cast<int8_t>((newest_ + 1) % kKept);
  slits_[newest_] = {at, ahead};
  // From another place, beams may have lost the wall.
  const bool was = same && (in_wall_ >> newest_ & 1U) != 0;
  const bool in_wall = was || (blocked(kWall) && blocked(-kWall));
  in_wall_ = static_cast<uint8_t>((in_wall_ & ~(1U << newest_)) | (in_wall ? 1U << newest_ : 0U));
  known_ = static_cast<uint8_t>(known_ | 1U << newest_);
}

void SlitSearch::look_on_boundary(const View& view, Side wall) noexcept {
  const int32_t travel_mm = behaviours_.progress.travel_mm();
  if (travel_mm - looked_mm_ <= behaviours_.mm(kEvery)) return;
  looked_mm_ = travel_mm;
  look(view, view.pose.heading);
  for (int32_t degrees = 60; degrees <= 105; degrees += 15) {
    look(view, view.pose.heading + 1_deg * (degrees * sign(wall)));
  }
}

uint8_t SlitSearch::within(const View& view, Length reference) const noexcept {
  const Params& params = behaviours_.params;
  const Length before = for_body(params, GapPassage::kSeenFrom), nearby = for_body(params, reference);
  uint32_t found = 0;
  for (int i = 0; i < kKept; ++i) {
    if ((known_ >> i & 1U) == 0) continue;
    const Vec from = slits_[i].at - polar(slits_[i].heading, before);
    if (!farther(view.pose.at - from, nearby)) found |= 1U << i;
  }
  return static_cast<uint8_t>(found);
}

bool SlitSearch::expected(const View& view) noexcept {
  const int32_t travel_mm = behaviours_.progress.travel_mm();
  if (!expected_) {
    // The loop closes before the body has passed the place where it began: a slit may lie between.
    const bool here = known() && within(view, kHere) != 0;
    expected_mm_ = travel_mm + behaviours_.mm(here ? kExpected : kPast);
  }
  expected_ = travel_mm < expected_mm_;
  return expected_;
}

void SlitSearch::end_loop(const View& view) noexcept {
  if (known()) known_ = static_cast<uint8_t>(known_ & ~within(view, kHere));
}

int SlitSearch::index_at_hand(const View& view) const noexcept {
  const uint8_t found = within(view, kAtHand);
  int i = 0;
  while (i < kKept - 1 && (found >> i & 1U) == 0) ++i;
  return i;
}

Pose SlitSearch::take(const View& view) noexcept {
  const int i = index_at_hand(view);
  known_ = static_cast<uint8_t>(known_ & ~(1U << i));
  expected_ = false;
  taken_ = slits_[i].at;
  return slits_[i];
}

bool SlitSearch::taken_near(Vec at) const noexcept {
  return !farther(at - taken_, for_body(behaviours_.params, kNear));
}

bool SlitSearch::tried(Vec at) const noexcept {
  for (int i = 0; i < attempts_ && i < kKeptTried; ++i) {
    if (!farther(at - tried_[i], for_body(behaviours_.params, kTried))) return true;
  }
  return false;
}

void SlitSearch::end_attempt() noexcept {
  if (attempts_ < kAttempts) tried_[attempts_++ % kKeptTried] = taken_;
  for (int i = 0; i < kKept; ++i) {
    if (attempts_ == kAttempts || tried(slits_[i].at)) known_ = static_cast<uint8_t>(known_ & ~(1U << i));
  }
}

}  // namespace whisker::planning
