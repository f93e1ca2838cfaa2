#include "firmware/nav/skirt.hpp"

#include "firmware/fuzzy/scale.hpp"

namespace whisker::nav {
namespace {

constexpr Length kProbe = 150_mm;
constexpr Length kShortProbe = 60_mm;
constexpr Length kProgress = 30_mm;
constexpr Length kFarView = 800_mm;
constexpr Length kLongest = 400_m;
constexpr int64_t kKeepSideTravel = 500000;  // um
constexpr Angle kFan = Angle::turns(75, 3600);
constexpr Angle kNotBack = 45_deg;
constexpr int32_t kEscapes = 6;
constexpr int32_t kFanSteps = 10;    // to 75 degrees
constexpr int32_t kSweepSteps = 20;  // to 150 degrees
constexpr int32_t kCircleSteps = 48;
constexpr Angle kFineFan = Angle::turns(25, 3600);
constexpr int32_t kFineCircleSteps = 144;
constexpr AngularRate kTurnRate = 2500_mrad_per_s;
constexpr AngularRate kSweepRate = 2000_mrad_per_s;
constexpr int64_t kDegree = INT64_C(11930465);  // 2^32 / 360

int64_t degrees(int64_t d) noexcept { return d * kDegree; }

/// gain x error, in 1/s.
AngularRate rate_towards(Angle error, int32_t gain) noexcept {
  constexpr int64_t kMicroradians = 6283185;  // a turn
  return AngularRate::from_raw(saturate32(scale_down<32>(error.wrapped() * kMicroradians) * gain));
}

Length close_enough(Length tolerance) noexcept { return tolerance - tolerance / 8; }

static_assert(sizeof(SkirtPlanner) + sizeof(ground::Patch) < 1024);

}  // namespace

SkirtPlanner::SkirtPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
    : params_(params), engine_(table) {}

void SkirtPlanner::set_goal(const Goal& goal) noexcept {
  goal_ = goal;
  request_ = Request::goal;
}

void SkirtPlanner::cancel() noexcept { request_ = Request::cancel; }

Decision SkirtPlanner::step(const View& view) noexcept {
  decision_.manoeuvre = {};
  decision_.looked = false;
  switch (request_) {
    case Request::none: break;
    case Request::goal: start(view); break;
    case Request::cancel: finish(Mode::idle, Why::cancelled, Outcome::none); break;
  }
  request_ = Request::none;
  if (phase_ != Phase::rest) {
    keep_account(view);
    act(view);
  }
  return decision_;
}

void SkirtPlanner::start(const View& view) noexcept {
  decision_ = Decision{};
  decision_.outcome = Outcome::running;
  last_ = view.pose;
  for (Vec& at : trail_) at = view.pose.at;
  escapes_ = 0;
  best_ = Length::from_raw(INT32_MAX);
  travel_um_ = 0;
  leave_travel_um_ = -kKeepSideTravel;
  hit_travel_um_ = 0;
  lean_ = 0;
  fine_ = false;
  stuck_ticks_ = 0;
  candidate_ = 0;
  enter(Phase::survey, Mode::surveying, Why::goal_set);
}

void SkirtPlanner::keep_account(const View& view) noexcept {
  travel_um_ += norm(view.pose.at - last_.at).raw();
  turned_ += (view.pose.heading - last_.heading).wrapped();
  last_ = view.pose;
  to_goal_ = goal_.at - view.pose.at;
  distance_ = norm(to_goal_);
  if (norm(view.pose.at - looks_at_) > 10_mm) {
    looks_at_ = view.pose.at;
    looks_here_ = 0;
  }
  if (norm(view.pose.at - trail_[trail_newest_]) > 40_mm) {
    trail_newest_ = (trail_newest_ + 1) % kTrail;
    trail_[trail_newest_] = view.pose.at;
    retreats_ = 0;
  }
  if (norm(view.pose.at - hit_at_) > 300_mm) moved_away_ = true;
}

void SkirtPlanner::act(const View& view) noexcept {
  if (travel_um_ > int64_t{kLongest.raw()}) {
    finish(Mode::gave_up, Why::length_budget, Outcome::gave_up);
    return;
  }
  if (distance_ <= close_enough(goal_.tolerance)) {
    if (phase_ != Phase::brake || next_ != Phase::rest) brake_then(Phase::rest);
    if (view.settled) finish(Mode::arrived, Why::at_goal, Outcome::reached);
    return;
  }
  switch (phase_) {
    case Phase::rest: break;
    case Phase::brake:
      if (view.settled) {
        phase_ = next_ == Phase::rest ? Phase::go : next_;
        slow_ticks_ = 0;
      }
      break;
    case Phase::survey: survey(view); break;
    case Phase::go: go(view); break;
    case Phase::look: look(view); break;
    case Phase::sweep_left:
    case Phase::sweep_right: sweep(view); break;
    case Phase::depart: depart(view); break;
    case Phase::follow: follow(view); break;
    case Phase::feel: feel(view); break;
    case Phase::retreat: retreat(view); break;
  }
}

void SkirtPlanner::survey(const View& view) noexcept {
  const Angle target = bearing(to_goal_);
  const Angle side = candidate_ == 0 ? 50_deg : -50_deg;
  if (face(view, target + side) && ++candidate_ == 2) enter(Phase::go, Mode::going, Why::target_free);
}

SkirtPlanner::Way SkirtPlanner::way(const View& view, Angle heading, Length length) const noexcept {
  const Length margin = fine_ ? params_.skirt.shield_margin : params_.skirt.planning_margin;
  const ground::Obstacles o = view.patch->along(view.pose.at, heading, length, params_.body.radius + margin);
  if (o.suspect > 0) return Way::blocked;
  return o.unknown > 0 ? Way::open : Way::free;
}

bool SkirtPlanner::choose_course(const View& view, Angle& course) noexcept {
  const ranges::Echo* const beam = view.sight.beam;
  const Angle target = bearing(to_goal_);
  const Length front = beam[hal::kFront].distance;
  decision_.inputs = fuzzy::scale(beam[hal::kLeft].distance, front, beam[hal::kRight].distance,
                                  params_.rangefinders.max_range, params_.thesis.distance_source);
  decision_.response = engine_(decision_.inputs);
  const Angle turn = front >= distance_ ? Angle{} : scaled(params_.thesis.base_turn, decision_.response.turn);
  const int64_t step = turn.wrapped() - lean_;
  const bool grows =
      (turn.wrapped() < 0 ? -int64_t{turn.wrapped()} : turn.wrapped()) > (lean_ < 0 ? -lean_ : lean_);
  lean_ += grows ? step * 3 / 10 : step * 3 / 50;

  const Length length = min(kProbe, distance_);
  course = target + Angle::from_raw(static_cast<uint32_t>(static_cast<uint64_t>(lean_)));
  decision_.why = lean_ > degrees(1) || lean_ < -degrees(1) ? Why::table : Why::target_free;
  if (way(view, course, length) != Way::blocked) return true;
  decision_.why = Why::narrow;
  course = target;
  if (way(view, course, length) != Way::blocked) return true;
  for (int32_t i = 1; i <= kFanSteps; ++i) {
    const int32_t signs[] = {-side_, side_};
    for (const int32_t sign : signs) {
      course = target + kFan * (i * sign);
      if (way(view, course, length) == Way::blocked) continue;
      side_ = -sign;
      return true;
    }
  }
  return false;
}

void SkirtPlanner::go(const View& view) noexcept {
  best_ = min(best_, distance_);
  if (view.sighted && !choose_course(view, course_)) {
    begin_hit(view);
    return;
  }
  if (stalled(view)) {
    look_along(course_, min(kProbe, distance_), Phase::go);
    return;
  }
  steer(view, course_, params_.wheels.max_speed);
}

bool SkirtPlanner::stalled(const View& view) noexcept {
  constexpr Speed kSlow = 20_mm_per_s;
  const bool turns = abs(view.turning) > AngularRate{300_mrad_per_s} * (params_.body.track / 2);
  const bool slow = view.forward < kSlow;
  slow_ticks_ = slow ? slow_ticks_ + (turns || view.granted == Q14::ratio(1, 1) ? 1 : 4) : 0;
  return slow_ticks_ >= 50;
}

void SkirtPlanner::look_along(Angle heading, Length length, Phase next) noexcept {
  look_length_ = length;
  look_course_ = heading;
  next_ = next;
  enter(Phase::look, Mode::looking, Why::unknown_ahead);
  decision_.manoeuvre.kind = Kind::stop;
  halting_ = true;
}

void SkirtPlanner::look(const View& view) noexcept {
  const ground::Obstacles o = view.patch->along(view.pose.at, look_course_, look_length_,
                                                params_.body.radius + params_.skirt.planning_margin);
  if (o.suspect > 0 || o.unknown == 0) {
    decision_.looked = true;
    phase_ = next_;
    decision_.mode = next_ == Phase::go ? Mode::going : Mode::skirting;
    slow_ticks_ = 0;
    return;
  }
  const Angle to_cell = bearing(o.nearest_unknown);
  const Angle side = params_.rangefinders.side_angle;
  Angle error = to_cell - view.pose.heading;
  const Angle sides[] = {side, -side};
  for (const Angle axis : sides) {
    const Angle e = to_cell - axis - view.pose.heading;
    if (magnitude(e) < magnitude(error)) error = e;
  }
  if (magnitude(error) > (1_deg).raw()) {
    halting_ = false;
    cruise(Speed{}, limit(rate_towards(error, 5), kTurnRate));
  } else if (!halting_) {
    decision_.manoeuvre.kind = Kind::stop;
    halting_ = true;
  }
}

void SkirtPlanner::begin_hit(const View& view) noexcept {
  hit_at_ = view.pose.at;
  hit_heading_ = view.pose.heading;
  hit_travel_um_ = travel_um_;
  turned_ = 0;
  moved_away_ = false;
  other_way_ = false;
  bearing_at_hit_ = bearing(to_goal_);
  exit_left_ = Exit{};
  exit_right_ = Exit{};
  reach_ = kProbe;
  candidate_ = 1;
  lean_ = 0;
  laps_ = 0;
  const bool turned_left = (view.pose.heading - bearing_at_hit_).wrapped() > 0;
  bool left_first = turned_left;
  if (travel_um_ - leave_travel_um_ < kKeepSideTravel) {
    left_first = side_ < 0;
    (left_first ? exit_right_ : exit_left_).turn_deg = 999;
  }
  enter(left_first ? Phase::sweep_left : Phase::sweep_right, Mode::searching, Why::target_blocked);
}

void SkirtPlanner::sweep(const View& view) noexcept {
  const bool left = phase_ == Phase::sweep_left;
  const int32_t sign = left ? 1 : -1;
  Exit& mine = left ? exit_left_ : exit_right_;
  Exit& other = left ? exit_right_ : exit_left_;
  const int32_t swept =
      static_cast<int32_t>((view.pose.heading - bearing_at_hit_).wrapped() * sign / kDegree);  // degrees
  cruise(Speed{}, kSweepRate * sign);
  if (!view.sighted) return;

  if (mine.open_deg == 0 && swept > 0 && swept <= 150 && view.sight.beam[hal::kFront].distance >= kFarView) {
    mine.open_deg = swept;
  }
  while (!mine.feasible && candidate_ <= kSweepSteps) {
    const Angle heading = bearing_at_hit_ + kFan * (candidate_ * sign);
    const Way found = way(view, heading, kProbe);
    if (found == Way::open && swept < candidate_ * 15 / 2 + 42 && swept < 165) break;
    if (found == Way::free) {
      mine.feasible = true;
      mine.heading = heading;
      mine.turn_deg = candidate_ * 15 / 2;
      break;
    }
    ++candidate_;
  }
  const auto score = [](const Exit& e) {
    return !e.feasible      ? 1000
           : e.open_deg > 0 ? max(Length::from_raw(e.open_deg), Length::from_raw(e.turn_deg)).raw()
                            : 150 + e.turn_deg / 4;
  };
  const bool found = mine.feasible && mine.open_deg > 0;
  const bool worse = other.feasible && swept > score(other);
  const bool over = swept >= 150 && (candidate_ > kSweepSteps || mine.feasible);
  if (!found && !worse && !over) return;
  if (other.turn_deg == 0) {
    candidate_ = 1;
    other.turn_deg = 0;
    mine.turn_deg = mine.feasible ? mine.turn_deg : 998;
    enter(left ? Phase::sweep_right : Phase::sweep_left, Mode::searching, Why::target_blocked);
    return;
  }
  const Exit* best = nullptr;
  int32_t wall = side_;
  if (exit_left_.feasible || exit_right_.feasible) {
    const int32_t l = score(exit_left_);
    const int32_t r = score(exit_right_);
    const bool go_left = l != r ? l < r
                         : exit_left_.turn_deg != exit_right_.turn_deg
                             ? exit_left_.turn_deg < exit_right_.turn_deg
                             : side_ < 0;
    best = go_left ? &exit_left_ : &exit_right_;
    wall = go_left ? -1 : 1;
  }
  side_ = wall;
  if (best == nullptr) {
    course_ = bearing_at_hit_;
    begin_feel(view);
    return;
  }
  course_ = best->heading;
  hit_heading_ = course_;
  enter(Phase::depart, Mode::skirting, wall < 0 ? Why::exit_left : Why::exit_right);
}

void SkirtPlanner::depart(const View& view) noexcept {
  if (!face(view, course_)) return;
  slow_ticks_ = 0;
  commit_until_um_ = travel_um_ + min(60_mm, reach_).raw();
  felt_travel_um_ = travel_um_;
  fine_ = false;
  enter(Phase::follow, Mode::skirting, decision_.why);
}

bool SkirtPlanner::came_round(const View& view) const noexcept {
  if (!moved_away_) return false;
  const int64_t length = travel_um_ - hit_travel_um_;
  const Length radius = min(350_mm, 150_mm + Length::from_raw(saturate32(length / 50)));
  return norm(view.pose.at - hit_at_) < radius && (turned_ > degrees(300) || turned_ < -degrees(300)) &&
         magnitude(view.pose.heading - hit_heading_) < (90_deg).raw();
}

/// Twice round something that is not what the robot hit.
bool SkirtPlanner::lost_wall(const View& view) noexcept {
  const int64_t turned = turned_ < 0 ? -turned_ : turned_;
  if (turned < degrees(360) * (laps_ + 1)) return false;
  const bool again = laps_ > 0 && norm(view.pose.at - lap_at_) < 350_mm;
  lap_at_ = view.pose.at;
  ++laps_;
  return again;
}

bool SkirtPlanner::may_leave(const View& view) noexcept {
  if (distance_ >= best_ - kProgress) return false;
  const Angle target = bearing(to_goal_);
  const bool wall_side = (target - view.pose.heading).wrapped() * int64_t{side_} > 0;
  const Way found = way(view, target, min(kProbe, distance_));
  return found == Way::free || (found == Way::open && !wall_side);
}

void SkirtPlanner::follow(const View& view) noexcept {
  if (view.sighted) {
    if (came_round(view)) {
      go_other_way(view);
      return;
    }
    if (lost_wall(view)) {
      if (++escapes_ > kEscapes) {
        finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
        return;
      }
      best_ = distance_;
      leave_travel_um_ = travel_um_ - kKeepSideTravel;
      enter(Phase::go, Mode::going, Why::wall_lost);
      return;
    }
    if (may_leave(view)) {
      leave_travel_um_ = travel_um_;
      lean_ = 0;
      enter(Phase::go, Mode::going, Why::target_free);
      go(view);
      return;
    }
    if (travel_um_ - felt_travel_um_ > 100000) {
      felt_travel_um_ = travel_um_;
      const Angle back = way_back(view);
      for (int32_t i = 4; i <= 7; ++i) {
        if (magnitude(view.pose.heading + 15_deg * (i * side_) - back) < kNotBack.raw()) continue;
        const ground::Obstacles o =
            view.patch->along(view.pose.at, view.pose.heading + 15_deg * (i * side_), 100_mm,
                              params_.body.radius + params_.skirt.planning_margin);
        if (o.suspect + o.unknown <= 6) {
          course_ = view.pose.heading;
          decision_.why = Why::opening;
          begin_feel(view);
          return;
        }
      }
    }
  }
  if (stalled(view)) {
    course_ = view.pose.heading;
    begin_feel(view);
    return;
  }
  if (travel_um_ < commit_until_um_) {
    steer(view, course_, params_.wheels.max_speed);
    return;
  }
  decision_.why = Why::edge;
  const ranges::Echo* const beam = view.sight.beam;
  const Angle outer = params_.rangefinders.side_angle + Angle::from_raw(params_.rangefinders.cone.raw() / 2);
  const Length wall = beam[side_ > 0 ? hal::kLeft : hal::kRight].distance * sin(outer);
  const Length other = beam[side_ > 0 ? hal::kRight : hal::kLeft].distance * sin(outer);
  const Length front = beam[hal::kFront].distance;
  const Length wanted = min(150_mm, (wall + other) / 2);
  const Length error = max(-100_mm, min(wall - wanted, 60_mm));
  const Length near = max(Length{}, 300_mm - front);
  const AngularRate turn = limit(AngularRate::from_raw((error * 20).raw() - (near * 15).raw()), kTurnRate);
  const bool lost = error == 60_mm && near == Length{};
  const Speed top = params_.wheels.max_speed;
  const Speed forward =
      lost ? abs(turn) * 180_mm : top - Speed::from_raw(multiply_divide(top.raw(), abs(turn).raw(), 4000000));
  cruise(forward, turn * side_);
}

void SkirtPlanner::go_other_way(const View& view) noexcept {
  if (other_way_) {
    finish(Mode::unreachable, Why::came_round, Outcome::unreachable);
    return;
  }
  other_way_ = true;
  side_ = -side_;
  hit_at_ = view.pose.at;
  hit_travel_um_ = travel_um_;
  turned_ = 0;
  laps_ = 0;
  moved_away_ = false;
  course_ = view.pose.heading + 180_deg;
  hit_heading_ = course_;
  decision_.why = Why::came_round;
  begin_feel(view);
}

Angle SkirtPlanner::way_back(const View& view) const noexcept {
  const Vec past = trail_[(trail_newest_ + kTrail - 3) % kTrail] - view.pose.at;
  return norm(past) < 60_mm ? view.pose.heading + 180_deg : bearing(past);
}

void SkirtPlanner::begin_feel(const View& view) noexcept {
  // From the wall's side, but not from beyond the wall: where the robot came from lies there.
  Angle swing = 110_deg;
  const Angle to_back = (way_back(view) - course_) * side_;
  const Angle past_back = to_back - kNotBack;
  if (to_back.raw() > kNotBack.raw() && past_back.raw() < swing.raw()) swing = past_back;
  feel_from_ = course_ + swing * side_;
  candidate_ = 0;
  reach_ = kProbe;
  fine_ = false;
  brake_then(Phase::feel);
}

void SkirtPlanner::feel(const View& view) noexcept {
  decision_.mode = Mode::searching;
  const Angle step = fine_ ? kFineFan : kFan;
  for (; candidate_ < (fine_ ? kFineCircleSteps : kCircleSteps); ++candidate_) {
    const Angle heading = feel_from_ - step * (candidate_ * side_);
    const Way found = way(view, heading, reach_);
    if (found == Way::blocked || (fine_ && found == Way::open)) continue;
    if (found == Way::open) {
      look_along(heading, reach_, Phase::feel);
      return;
    }
    course_ = heading;
    enter(Phase::depart, Mode::skirting, Why::edge);
    return;
  }
  if (reach_ == kProbe) {
    reach_ = kShortProbe;
    candidate_ = 0;
    return;
  }
  if (!fine_) {
    fine_ = true;
    candidate_ = 0;
    return;
  }
  retreat_to_ = trail_[(trail_newest_ + kTrail - 2) % kTrail];
  course_ = bearing(retreat_to_ - view.pose.at);
  fine_ = false;
  enter(Phase::retreat, Mode::skirting, Why::way_back);
}

void SkirtPlanner::retreat(const View& view) noexcept {
  const Vec rest = retreat_to_ - view.pose.at;
  const Angle back = bearing(rest);
  if (norm(rest) < 10_mm || stalled(view)) {
    course_ = view.pose.heading;
    if (norm(rest) < 10_mm) {
      felt_travel_um_ = travel_um_;
      enter(Phase::follow, Mode::skirting, Why::edge);
    } else if (++retreats_ < 8) {
      begin_feel(view);
    } else {
      finish(Mode::gave_up, Why::no_exit, Outcome::gave_up);
    }
    return;
  }
  steer(view, back, params_.wheels.max_speed / 2);
}

void SkirtPlanner::enter(Phase phase, Mode mode, Why why) noexcept {
  phase_ = phase;
  decision_.mode = mode;
  decision_.why = why;
}

void SkirtPlanner::brake_then(Phase next) noexcept {
  phase_ = Phase::brake;
  next_ = next;
  decision_.manoeuvre = {};
  decision_.manoeuvre.kind = Kind::stop;
}

void SkirtPlanner::steer(const View& view, Angle heading, Speed top) noexcept {
  const Angle error = heading - view.pose.heading;
  const AngularRate turn = limit(rate_towards(error, 6), kTurnRate);
  const int64_t slower = 1000000 - abs(rate_towards(error, 1)).raw() * INT64_C(12) / 10;
  const Speed forward =
      slower <= 0 ? Speed{}
                  : Speed::from_raw(multiply_divide(top.raw(), static_cast<int32_t>(slower), 1000000));
  cruise(forward, turn);
}

bool SkirtPlanner::face(const View& view, Angle heading) noexcept {
  const Angle error = heading - view.pose.heading;
  cruise(Speed{}, limit(rate_towards(error, 5), kTurnRate));
  return magnitude(error) < (3_deg).raw();
}

void SkirtPlanner::cruise(Speed forward, AngularRate turn) noexcept {
  decision_.manoeuvre = {};
  decision_.manoeuvre.kind = Kind::cruise;
  decision_.manoeuvre.forward = forward;
  decision_.manoeuvre.turning = turn * (params_.body.track / 2);
}

void SkirtPlanner::finish(Mode mode, Why why, Outcome outcome) noexcept {
  phase_ = Phase::rest;
  decision_.mode = mode;
  decision_.why = why;
  decision_.outcome = outcome;
  decision_.manoeuvre = {};
  decision_.manoeuvre.kind = Kind::stop;
}

}  // namespace whisker::nav
