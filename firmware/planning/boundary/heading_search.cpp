#include "firmware/planning/boundary/heading_search.hpp"

#include "firmware/planning/candidate_headings.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

// All lengths are for the reference body.
constexpr Length kApart = 40_mm;
constexpr Angle kSwing = 110_deg;
constexpr Angle kNotBack = 45_deg;
constexpr Length kShortWay = 60_mm;
constexpr Length kThere = 10_mm;
constexpr int8_t kRetreats = 8;
// A scan ends where the path is occupied. If the counts of an encoder shift the path by a cell, it may be
// unknown again as soon as the body stands.
constexpr int8_t kScans = 8;
constexpr Length kOpeningWay = 100_mm;
constexpr int32_t kOpeningCells = 6;

}  // namespace

void HeadingSearch::reset(Vec at, const Params& params) noexcept {
  breadcrumbs_.reset(at, for_body(params, kApart));
  retreats_ = 0;
}

void HeadingSearch::move(Vec at) noexcept {
  if (breadcrumbs_.add(at)) retreats_ = 0;
}

void HeadingSearch::begin(Angle first, const Pose& pose, Side wall) noexcept {
  back_ = breadcrumbs_.way_back(pose);
  may_return_ = magnitude(back_ - first) < kNotBack.raw();
  first_ = first;
  wall_ = wall;
  candidate_ = 0;
  scans_ = 0;
  effort_ = Effort::full;
}

void HeadingSearch::begin_at_wall(Angle ahead, const Pose& pose, Side wall) noexcept {
  begin(ahead, pose, wall);
  Angle swing = kSwing;
  const Angle to_back = (back_ - ahead) * sign(wall);
  if (to_back.raw() > kNotBack.raw() && (to_back - kNotBack).raw() < swing.raw()) swing = to_back - kNotBack;
  first_ = ahead + swing * sign(wall);
}

HeadingSearch::Found HeadingSearch::step(const View& view, const Params& params, Heading& found) noexcept {
  constexpr Angle kStep = Angle::turns(1, kCandidateHeadings);
  constexpr Angle kFineStep = Angle::turns(1, 3 * kCandidateHeadings);
  const bool narrow = effort_ == Effort::narrow_ways;
  const Angle step = narrow ? kFineStep : kStep;
  const Reach& reach = view.local_grid->reach();
  const Length beside = narrow ? reach.guard : reach.planning;
  found.length = effort_ == Effort::full ? reach.probe : for_body(params, kShortWay);
  Share share(view);
  for (const int32_t all = narrow ? 3 * kCandidateHeadings : kCandidateHeadings; candidate_ < all; refuse()) {
    if (!share.more()) return Found::nothing;
    found.angle = first_ - step * (candidate_ * sign(wall_));
    if (!may_return_ && magnitude(found.angle - back_) < kNotBack.raw()) continue;
    const Way there = way(view, found.angle, found.length, beside);
    if (there == Way::free) return Found::free;
    if (there == Way::unknown && !narrow && scans_++ < kScans) return Found::unseen;
  }
  candidate_ = 0;
  scans_ = 0;
  switch (effort_) {
    case Effort::full: effort_ = Effort::short_ways; return Found::nothing;
    case Effort::short_ways: effort_ = Effort::narrow_ways; return Found::nothing;
    case Effort::narrow_ways: effort_ = Effort::full; break;
  }
  if (!may_return_) {
    may_return_ = true;
    return Found::nothing;
  }
  for (int i = 0; i < kBack; ++i) retreat_[i] = breadcrumbs_.back(i);
  retreated_ = 0;
  return Found::none;
}

HeadingSearch::Retreat HeadingSearch::retreat(const View& view, bool stalled, const Params& params,
                                              Manoeuvre& manoeuvre) noexcept {
  const Vec rest = retreat_[retreated_] - view.pose.at;
  const bool there = norm(rest) < for_body(params, kThere) && ++retreated_ == kBack;
  if (there || stalled) {
    if (++retreats_ == kRetreats) return Retreat::lost;
    return there ? Retreat::there : Retreat::stuck;
  }
  manoeuvre = steer(bearing(rest) - view.pose.heading, params.wheels.max_speed / 4, params);
  return Retreat::under_way;
}

bool HeadingSearch::opening(const View& view, Side wall, const Params& params) const noexcept {
  const Angle back = breadcrumbs_.way_back(view.pose);
  const Length length = for_body(params, kOpeningWay);
  for (int32_t degrees = 60; degrees <= 105; degrees += 15) {
    const Angle heading = view.pose.heading + 1_deg * (degrees * sign(wall));
    if (magnitude(heading - back) < kNotBack.raw()) continue;
    const perception::Obstacles o = view.local_grid->along(
        view.pose.at, heading, length, view.local_grid->reach().planning, kOpeningCells + 1);
    if (o.suspect + o.unknown <= kOpeningCells) return true;
  }
  return false;
}

}  // namespace whisker::planning
