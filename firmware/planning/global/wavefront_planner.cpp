#include "firmware/planning/global/wavefront_planner.hpp"

#include "firmware/planning/global/raytrace.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kEvery = 16;
constexpr uint8_t kMostKept = 1;  // plans in a row that keep a wavefront that is still open
// Units of Work:
constexpr int32_t kMarkUnits = 30;
constexpr int32_t kMarkRowUnits = 3;  // of a row that a mark looks at,
constexpr int32_t kHeldRowUnits = 6;  // and while a wavefront is under way
constexpr int32_t kCellUnits = 8;     // of a step on the way
constexpr int32_t kLineUnits = 2;     // of a cell on a straight line
constexpr int32_t kWordsMovedAUnit = 2;
constexpr int32_t kUnits = 3, kWords = 4;  // units of so many words of the wavefront
constexpr int32_t kEndUnits = 200;         // of the end of a wavefront
constexpr Length kDearer = 2500_mm;        // extra cost accepted to avoid suspected cells that are far away
constexpr Length kLittle = 400_mm;         // the same if they are at hand
constexpr Length kFarAway = 1500_mm;
constexpr Length kDecides = 550_mm;  // the beams tell a door from a wall
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
  pass();
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
  const GridMap::Hold hold = wavefront_.hold();
  for (int i = 0; i < hal::kBeams; ++i) {
    if ((view.observed >> i & 1U) == 0) continue;
    const int32_t rows = map_.mark(view.observations[i], floods() ? &hold : nullptr, view.doubts);
    view.local_grid->work().add(kMarkUnits + rows * (floods() ? kHeldRowUnits : kMarkRowUnits));
  }
  if (!floods()) map_.set(map_.place(view.pose.at), CellState::free);
  ++ticks_;
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

void WavefrontPlanner::pass() noexcept {
  for (VirtualObstacle& b : virtual_obstacles_) b = {};
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

void WavefrontPlanner::ponder(const View& view) noexcept {
  switch (stage_) {
    case Stage::idle:
      if (waits_ || ticks_ >= kEvery) prepare(view);
      return;
    case Stage::copy: copy(view); return;
    case Stage::ready: begin_plan(view); return;
    case Stage::strict:
    case Stage::passing: flood(view); return;
    case Stage::look: look_on(view); return;
  }
}

void WavefrontPlanner::flood(const View& view) noexcept {
  const Work& work = view.local_grid->work();
  if (!wavefront_.over()) {
    const int32_t words = work.left() * kWords / kUnits;
    int32_t spare = 0;
    const bool over = wavefront_.run(map_, words, &spare);
    work.add((words - spare) * kUnits / kWords);
    if (!over || work.left() < kEndUnits) return;
  }
  map_.release(wavefront_.hold());
  work.add(kEndUnits);
  end_wavefront(view);
}

void WavefrontPlanner::prepare(const View& view) noexcept {
  const Work& work = view.local_grid->work();
  // A large window takes long to move.
  if (map_.follow(view.pose.at, goal_.at)) {
    work.add(map_.shape().size() / kWordsMovedAUnit);
    kept_ = kMostKept;
    return;
  }
  ticks_ = 0;
  more_ = narrow<int16_t>(2 * map_.reach_of(*view.local_grid) + 1);
  stage_ = Stage::copy;
  copy(view);
}

/// What the local grid knows, before the plan begins.
void WavefrontPlanner::copy(const View& view) noexcept {
  const int32_t reach = map_.reach_of(*view.local_grid);
  while (more_ > 0 && view.local_grid->work().left() > 0) {
    --more_;
    map_.free(*view.local_grid, view.pose.at, more_ - reach);
  }
  if (more_ > 0) return;
  place_virtual_obstacles();
  place_contacts(view);
  stage_ = Stage::ready;
  if (view.local_grid->work().left() > kEndUnits) begin_plan(view);
}

void WavefrontPlanner::begin_plan(const View& view) noexcept {
  if (!waits_ && kept_ < kMostKept && still_open(view)) {
    ++kept_;
    find_way(view);
    return;
  }
  kept_ = 0;
  begin(Stage::strict, view);
}

/// The last wavefront still leads from here around all that blocks, and no better one has been asked for.
bool WavefrontPlanner::still_open(const View& view) const noexcept {
  if (!has_way_ || detour_ || !wavefront_.strict() || wavefront_.goal() != map_.place(goal_.at)) return false;
  Cell p = map_.place(view.pose.at);
  if (wavefront_.phase(map_, p) < 0) return false;
  const Cell goal = wavefront_.goal();
  // Farther away, the beams see nothing.
  for (int32_t more = reference(kHorizon).raw() / map_.cell().raw(); more > 0; --more) {
    view.local_grid->work().add(kCellUnits);
    if (!wavefront_.next(map_, p, goal, p)) return p == goal || map_.at_rim(p);
    if (wavefront_.blocked(map_, p)) return false;
  }
  return true;
}

void WavefrontPlanner::end_wavefront(const View& view) noexcept {
  if (stage_ == Stage::strict) {
    strict_ = wavefront_.reached() ? wavefront_.level() : kNoWay;
    detour_ = wavefront_.outside() ||
              strict_ - cell_distance(map_.place(goal_.at) - map_.place(view.pose.at)) > levels(kLittle);
    if (!detour_) shut_ = false;
    // The way of this wavefront is the one to take if suspect cells make it little longer.
    if (wavefront_.reached()) {
      find_way(view);
    } else {
      begin(Stage::passing, view);
    }
    return;
  }
  no_way_ = !wavefront_.reached();
  shut_ = no_way_ || (wavefront_.outside() && map_.holds(map_.place(goal_.at)));
  if (no_way_) {
    has_way_ = false;
    end_plan();
  } else if (strict_ - wavefront_.level() > accepted(view)) {
    find_way(view);
  } else {
    has_way_ = true;
    way_ = seen_;
    end_plan();
  }
}

/// The way is found, and at the end of a plan the body takes it.
void WavefrontPlanner::take_way(const View& view) noexcept {
  // One that passes suspect cells may be much shorter.
  if (detour_ && wavefront_.strict()) {
    begin(Stage::passing, view);
    return;
  }
  has_way_ = true;
  no_way_ = false;
  way_ = seen_;
  end_plan();
}

void WavefrontPlanner::drop_plan() noexcept {
  if (floods()) map_.release(wavefront_.hold());
  stage_ = Stage::idle;
}

void WavefrontPlanner::end_plan() noexcept {
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

bool WavefrontPlanner::sees(const View& view, Vec to) const noexcept {
  int32_t cells = 0;
  const bool open = raytrace(map_, view.pose.at, to, [&](Cell p) {
    ++cells;
    return !wavefront_.blocked(map_, p);
  });
  view.local_grid->work().add((cells + 4) * kLineUnits);
  return open;
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

/// On its way to the goal, the body drives on until it sees what an echo on the straight line comes from.
bool WavefrontPlanner::undecided(const View& view) const noexcept {
  if (has_way_ && !(way_ == goal_.at)) return false;
  Cell first;
  const bool open = raytrace(map_, view.pose.at, goal_.at, [&](Cell p) {
    view.local_grid->work().add(kLineUnits);
    first = p;
    return map_.holds(p) && map_.at(p) < CellState::suspect;
  });
  return !open && map_.holds(first) && map_.at(first) == CellState::suspect &&
         farther(map_.middle(first) - view.pose.at, reference(kDecides));
}

void WavefrontPlanner::find_way(const View& view) noexcept {
  on_ = map_.place(view.pose.at);
  if (straight(view) || undecided(view)) {
    seen_ = goal_.at;
  } else if (has_way_ && farther(way_ - view.pose.at, reference(kReached)) &&
             dearer(view.pose.at, way_) <= reference(kKept)) {
    seen_ = way_;
  } else if (wavefront_.phase(map_, on_) < 0) {
    has_way_ = no_way_ = false;
    end_plan();
    return;
  } else {
    stage_ = Stage::look;
    first_ = true;
    more_ = narrow<int16_t>(reference(kHorizon).raw() / map_.cell().raw());
    seen_ = goal_.at;
    look_on(view);
    return;
  }
  take_way(view);
}

/// The way point is the farthest cell of the way that the body sees.
void WavefrontPlanner::look_on(const View& view) noexcept {
  const Work& work = view.local_grid->work();
  const Cell goal = map_.place(goal_.at);
  while (more_ > 0) {
    if (work.left() <= 0) return;
    --more_;
    if (!wavefront_.next(map_, on_, goal, on_)) break;
    const Vec at = on_ == goal ? goal_.at : map_.middle(on_);
    work.add(kCellUnits);
    if (first_ || sees(view, at)) seen_ = at;
    first_ = false;
  }
  take_way(view);
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
  drop_plan();
  map_.doubt_all();
  pass();
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
  drop_plan();
  waits_ = true;
  return true;
}

}  // namespace whisker::planning
