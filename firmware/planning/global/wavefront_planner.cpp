#include "firmware/planning/global/wavefront_planner.hpp"

#include "firmware/planning/global/raytrace.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kRowsATick = 800;
constexpr int32_t kEvery = 16;
constexpr Length kDearer = 2500_mm;  // extra cost accepted to avoid suspected cells that are far away
constexpr Length kLittle = 400_mm;   // the same if they are at hand
constexpr Length kFarAway = 1500_mm;
constexpr Length kHorizon = 3000_mm;
constexpr Length kAhead = 600_mm;
constexpr Length kSlack = 100_mm;
constexpr Length kKept = 100_mm;
constexpr Length kReached = 250_mm;
constexpr Length kNoProgress = 20_m;  // of the first attempt; halves with each later one
constexpr Length kLastTry = 8_m;
constexpr Length kProgress = 150_mm;
constexpr Length kBarred = 200_mm;
constexpr Length kObstacleRadius = 120_mm;
constexpr Length kObstacleLife = 6000_mm;
constexpr int32_t kRefusals = 12;
constexpr int8_t kMostAttempts = 16;
constexpr int32_t kNoWay = INT32_MAX / 2;  // levels

}  // namespace

void WavefrontPlanner::start(const View& view, const Goal& goal) noexcept {
  goal_ = goal;
  map_.configure(params_);
  map_.reset(view.pose.at, goal.at);
  stage_ = Stage::idle;
  has_way_ = no_way_ = shut_ = last_try_ = waits_ = false;
  active_ = true;
  refusals_ = attempts_ = 0;
  best_.reset();
  started_um_ = view.travelled_um;
  travel_mm_ = improved_mm_ = 0;
  for (VirtualObstacle& b : virtual_obstacles_) b = {};
}

void WavefrontPlanner::move_goal(Vec at) noexcept {
  if (way_ == goal_.at) way_ = at;
  goal_.at = at;
  best_.follow(at);
}

void WavefrontPlanner::observe(const View& view) noexcept {
  travel_mm_ = static_cast<int32_t>((view.travelled_um - started_um_) / 1000);
  const Length distance = norm(goal_.at - view.pose.at);
  if (distance < best_.distance() - reference(kProgress)) {
    best_.set(view.pose.at, distance);
    improved_mm_ = travel_mm_;
    refusals_ = 0;
    active_ = true;
    last_try_ = false;
  }
  const bool hold = stage_ != Stage::idle;
  for (int i = 0; i < hal::kBeams; ++i) {
    if ((view.observed >> i & 1U) != 0) map_.mark(view.observations[i], hold, view.doubts);
  }
  const Cell body = map_.place(view.pose.at);
  if (!hold) map_.set(body, CellState::free);
  plan(view);
}

void WavefrontPlanner::place_virtual_obstacles() noexcept {
  const int32_t reach = reference(kObstacleRadius).raw() / map_.cell().raw() + 1;
  for (const VirtualObstacle& b : virtual_obstacles_) {
    if (b.until_mm <= travel_mm_) continue;
    const Cell centre = map_.place(b.at);
    for (int32_t dy = -reach; dy <= reach; ++dy) {
      for (int32_t dx = -reach; dx <= reach; ++dx) {
        const Cell p = centre + Cell{dx, dy};
        if (!farther(map_.middle(p) - b.at, reference(kObstacleRadius))) map_.set(p, CellState::occupied);
      }
    }
  }
}

/// The body may stand on the cell of a contact: a cell may be larger than the body.
void WavefrontPlanner::place_contacts(const View& view) noexcept {
  if (view.contacts == nullptr) return;
  const Cell body = map_.place(view.pose.at);
  for (int i = 0; i < view.contacts->count(); ++i) {
    const Cell cell = map_.place(view.contacts->at(i));
    if (!(cell == body)) map_.set(cell, CellState::occupied);
  }
}

void WavefrontPlanner::begin(Stage stage, const View& view) noexcept {
  stage_ = stage;
  Wavefront::Task task;
  task.body = map_.place(view.pose.at);
  task.goal = map_.place(goal_.at);
  task.strict = stage != Stage::passing;
  wavefront_.begin(map_, task);
}

void WavefrontPlanner::plan(const View& view) noexcept {
  ++ticks_;
  if (stage_ == Stage::idle) {
    if (ticks_ < kEvery && !waits_) return;
    ticks_ = 0;
    map_.follow(view.pose.at, goal_.at);
    map_.free(*view.local_grid, view.pose.at);
    place_virtual_obstacles();
    place_contacts(view);
    begin(Stage::strict, view);
    return;
  }
  if (!wavefront_.run(map_, kRowsATick * map_.shape().words)) return;
  switch (stage_) {
    case Stage::idle: break;
    case Stage::strict:
      strict_ = wavefront_.reached() ? wavefront_.level() : kNoWay;
      if (!wavefront_.outside() &&
          strict_ - cell_distance(map_.place(goal_.at) - map_.place(view.pose.at)) <= levels(kLittle)) {
        shut_ = false;
        break;
      }
      begin(Stage::passing, view);
      return;
    case Stage::passing:
      no_way_ = !wavefront_.reached();
      shut_ = no_way_ || (wavefront_.outside() && map_.holds(map_.place(goal_.at)));
      if (!wavefront_.reached()) {
        has_way_ = false;
        stage_ = Stage::idle;
        waits_ = false;
        return;
      }
      if (strict_ - wavefront_.level() > accepted(view)) break;
      begin(Stage::again, view);
      return;
    case Stage::again: break;
  }
  finish(view);
  stage_ = Stage::idle;
  waits_ = false;
}

int32_t WavefrontPlanner::levels(Length l) const noexcept { return reference(l).raw() / map_.cell().raw(); }

/// How many levels the body may drive more to avoid suspected cells of the plan: little more than half of the
/// way to the first one, because on this way it sees whether something is there.
int32_t WavefrontPlanner::accepted(const View& view) const noexcept {
  const int32_t most = levels(kFarAway);
  const Cell goal = map_.place(goal_.at);
  Cell p = map_.place(view.pose.at);
  int32_t steps = 0;
  while (steps < most && wavefront_.next(map_, p, goal, p) && map_.at(p) != CellState::suspect) ++steps;
  return steps == most ? levels(kDearer) : levels(kLittle) + steps / 2;
}

bool WavefrontPlanner::sees(Vec from, Vec to) const noexcept {
  return raytrace(map_, from, to, [this](Cell p) { return !wavefront_.blocked(map_, p); });
}

/// Extra cost of the straight line over the best path; the maximum if an obstacle blocks the line.
Length WavefrontPlanner::dearer(Vec from, Vec to) const noexcept {
  constexpr Length kBlocked = Length::from_raw(INT32_MAX);
  int32_t levels = 0;
  int before = wavefront_.phase(map_, map_.place(from));
  if (before < 0) return kBlocked;
  bool leaves = false;
  const bool open = raytrace(map_, from, to, [&](Cell p) {
    const int now = wavefront_.phase(map_, p);
    if (now < 0) {
      // A line that leaves the window does not return, so its remainder may have any length.
      leaves = !map_.holds(p);
      return false;
    }
    levels += (now - before + 4) % 3 - 1;
    before = now;
    return true;
  });
  return open || leaves ? map_.cell() * levels + norm(to - from) : kBlocked;
}

bool WavefrontPlanner::straight(const View& view) const noexcept {
  const Vec to_goal = goal_.at - view.pose.at;
  const Vec ahead = polar(bearing(to_goal), min(norm(to_goal), reference(kAhead)));
  return dearer(view.pose.at, view.pose.at + ahead) <= reference(kSlack);
}

void WavefrontPlanner::finish(const View& view) noexcept {
  const bool had_way = has_way_;
  has_way_ = true;
  no_way_ = false;
  if (straight(view)) {
    way_ = goal_.at;
    return;
  }
  if (had_way && farther(way_ - view.pose.at, reference(kReached)) &&
      dearer(view.pose.at, way_) <= reference(kKept)) {
    return;
  }
  const Cell goal = map_.place(goal_.at);
  Cell p = map_.place(view.pose.at);
  if (wavefront_.phase(map_, p) < 0) {
    has_way_ = false;
    return;
  }
  const int32_t most = reference(kHorizon).raw() / map_.cell().raw();
  Cell on = p;
  bool first = true;
  for (int32_t i = 0; i < most && wavefront_.next(map_, p, goal, on); ++i) {
    p = on;
    const Vec at = p == goal ? goal_.at : map_.middle(p);
    if (first || sees(view.pose.at, at)) way_ = at;
    first = false;
  }
  if (first) way_ = goal_.at;
}

/// Whether the robot drove too far without getting nearer to the goal.
bool WavefrontPlanner::spent() const noexcept {
  const int32_t in_vain = travel_mm_ - improved_mm_;
  return in_vain > (last_try_ ? mm(kLastTry) : mm(kNoProgress) >> attempts_);
}

GlobalPlanner::Advice WavefrontPlanner::advise(const View& view, Length, Vec& place) noexcept {
  if (active_ && spent()) hand_over();
  if (last_try_ && (shut_ || !active_)) return Advice::no_way;
  if (!active_) return Advice::none;
  if (waits_) return Advice::wait;
  if (!has_way_) return Advice::none;
  place = way_ - view.pose.at;
  return Advice::place;
}

void WavefrontPlanner::hand_over() noexcept {
  active_ = false;
  if (attempts_ < kMostAttempts) ++attempts_;
}

void WavefrontPlanner::bar(Vec at) noexcept {
  newest_ = static_cast<int8_t>((newest_ + 1) % kVirtualObstacles);
  virtual_obstacles_[newest_] = {at, travel_mm_ + mm(kObstacleLife)};
}

bool WavefrontPlanner::doubt() noexcept {
  if (shut_ || last_try_) return false;
  last_try_ = true;
  map_.doubt_all();
  for (VirtualObstacle& b : virtual_obstacles_) b = {};
  stage_ = Stage::idle;
  has_way_ = false;
  waits_ = active_ = true;
  refusals_ = 0;
  improved_mm_ = travel_mm_;
  return true;
}

bool WavefrontPlanner::refuse(const View& view) noexcept {
  if (!active_) return false;
  if (++refusals_ > kRefusals) {
    hand_over();
    return last_try_;
  }
  bar(view.pose.at + polar(bearing(way_ - view.pose.at), reference(kBarred)));
  stage_ = Stage::idle;
  waits_ = true;
  return true;
}

}  // namespace whisker::planning
