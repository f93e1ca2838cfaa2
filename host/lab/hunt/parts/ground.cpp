// How long ground stays clear, and what takes it back.
#include <map>
#include <utility>

#include "host/lab/hunt/parts/grid_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

/// What drops out of the window is forgotten, the rest is kept while it is young, and nothing wraps around.
std::string judge_window(Dice& dice) {
  const Params p;
  LocalGrid grid;
  grid.configure(p);
  Pose pose = draw_pose(dice);
  pose.heading = Angle::turns(dice.index(8), 8);
  grid.reset(pose);
  const double radius = metres(rim_sweep(p).radius), young = 0.98 * metres(derived::kAgeTravel);
  double travelled = 0;
  // Clear cells, each with the travel from which on it has been clear.
  using Cells = std::map<std::pair<std::int32_t, std::int32_t>, double>;
  const auto all = [&](const Cells& earlier) {
    Cells cells;
    each_cell(pose.at, grid_cell(p), [&](Vec at) {
      const auto known = earlier.find({at.x.raw(), at.y.raw()});
      if (grid.is_clear(at))
        cells[{at.x.raw(), at.y.raw()}] = known == earlier.end() ? travelled : known->second;
    });
    return cells;
  };
  Cells before = all({});
  for (int step = 0; step < 12; ++step) {
    const int reach = dice.chance(0.1) ? 1500 : 60;
    const Vec way{millimetres(dice.index(2 * reach + 1) - reach),
                  millimetres(dice.index(2 * reach + 1) - reach)};
    pose.at = pose.at + way;
    travelled += length_of(vec(way));
    grid.move_to(pose);
    const Cells now = all(before);
    for (const auto& [place, since] : now) {
      const auto [x, y] = place;
      const Square square = Square::around({Length::from_raw(x), Length::from_raw(y)}, grid_cell(p));
      if (before.count({x, y}) == 0 && square.farthest(vec(pose.at)) > radius + 1e-4)
        return "clear ground from nowhere";
    }
    for (const auto& [place, since] : before) {
      const bool inside =
          well_inside(p, pose, {Length::from_raw(place.first), Length::from_raw(place.second)});
      if (inside && travelled - since < young && now.count(place) == 0) return "clear ground is lost";
    }
    ConeObservation seen;
    seen.beam = {pose.at, draw_angle(dice), Angle::from_raw(p.rangefinders.cone.raw() / 2)};
    seen.free = 2_m;
    grid.mark(seen);
    before = all(now);
  }
  return "";
}

/// One standard deviation of the heading, in radians: twice of it moves the ground at the distance that the
/// guard looks at by half a cell.
double allowed_error(const Params& p) {
  const Reach far = reach(p);
  return metres(grid_cell(p)) / (4 * metres(far.guard + far.probe));
}
/// In metres, by the declared errors of the two wheels, which are independent of one another.
double travel_span(const Params& p) {
  const double apart = std::sqrt(2) * p.pose_error.wheel_scale.raw() * 1e-6;
  return std::clamp(allowed_error(p) * metres(p.body.track) / std::max(apart, 1e-9), 0.1,
                    metres(derived::kAgeTravel));
}
/// In whole turns.
double turned_span(const Params& p) {
  const double together = std::sqrt(0.5) * p.pose_error.wheel_scale.raw() * 1e-6;
  const double turns = allowed_error(p) / (2 * sim::kPi) / std::max(together, 1e-9);
  return std::clamp(turns, 0.25, derived::kAgeTurn.raw() / 4294967296.0);
}

/// Clear ground lives for one to two spans of travel or turning.
std::string judge_age(Dice& dice) {
  Params p;
  if (dice.chance(0.7)) p.pose_error.wheel_scale = millionths(1 + dice.index(40000));
  LocalGrid grid;
  grid.configure(p);
  Pose pose{{}, Angle{}};
  grid.reset(pose);
  ConeObservation seen;
  seen.beam = {pose.at, Angle{}, Angle::from_raw(p.rangefinders.cone.raw() / 2)};
  seen.free = 2_m;
  grid.mark(seen);
  const Vec there{250_mm, 0_mm};
  if (!grid.is_clear(there)) return "ground seen empty is not clear";
  const bool turns = dice.chance(0.5);
  const double span = turns ? turned_span(p) : travel_span(p), step = turns ? 5.0 / 360 : 0.01;
  double spent = 0;
  for (bool even = false; spent < 2.1 * span + 3 * step; even = !even) {
    if (turns) {
      pose.heading = even ? Angle{} : 5_deg;
    } else {
      pose.at.y = even ? 0_mm : 10_mm;
    }
    spent += step;
    grid.move_to(pose);
    const bool clear = grid.is_clear(there);
    if (!clear && spent < 0.98 * span) return "clear ground expires too soon";
    if (clear && spent > 2.02 * span + 2 * step) return "clear ground never expires";
  }
  return "";
}

/// An echo takes back the arc that it comes from, where all of that is clear, and nothing else.
std::string judge_revocation(Dice& dice) {
  const Params p;
  const double cell = metres(grid_cell(p));
  const Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  grid.move_to(pose);
  const auto beam = [&](Angle off) {
    return perception::Beam{pose.at, pose.heading + off, Angle::from_raw(p.rangefinders.cone.raw() / 2)};
  };
  for (int deg = -44; deg <= 44; deg += 2) {
    ConeObservation seen;
    seen.beam = beam(Angle::turns(deg, 360));
    seen.free = 2_m;
    grid.mark(seen);
  }
  const LocalGrid before = grid;
  const perception::Beam echo = beam(Angle::turns(dice.index(41) - 20, 360));
  const Length nearest = millimetres(130 + dice.index(90)), farthest = nearest + millimetres(dice.index(40));
  const bool takes = dice.chance(0.5);
  if (takes) grid.take_back(echo, nearest, farthest);
  if (!takes) grid.revoke(echo, nearest, farthest);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    if (!before.is_clear(at)) return;
    const Vec2 off = vec(at) - vec(echo.apex);
    const double far = length_of(off);
    const double angle =
        std::fabs(std::remainder(std::atan2(off.y, off.x) - radians(echo.axis), 2 * sim::kPi));
    const double half = radians(echo.half_cone);
    const bool in = far > metres(nearest) && far < metres(farthest) + cell * 0.9 && angle < half - 0.01;
    const bool out =
        far < metres(nearest) - cell || far > metres(farthest) + 2 * cell || (angle - half) * far > cell;
    if (in && grid.is_clear(at)) wrong = "an echo leaves its ground clear";
    if (out && !grid.is_clear(at)) wrong = "an echo takes other ground back";
  });
  return wrong;
}

/// Someone says that nothing stands within a distance.
std::string judge_vouched(Dice& dice) {
  const Params p;
  const Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  perception::Beam beams[3];
  Length free[3];
  for (int i = 0; i < 3; ++i) {
    beams[i] = perception::beam_of(mount(p.rangefinders, i), pose);
    free[i] = millimetres(150 + dice.index(300));
  }
  const Length radius = millimetres(100 + dice.index(120));
  grid.vouch(pose.at, radius, beams, free);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    const Square square = Square::around(at, grid_cell(p));
    const bool clear = grid.is_clear(at);
    const double by = metres(radius) - square.farthest(vec(pose.at));
    if (clear && by < -1e-4 && !is_under(p, pose, at)) wrong = "ground beyond the vouched is clear";
    bool covered = false, beside = true;
    for (int i = 0; i < 3; ++i) {
      covered = covered || empty_by(square, beams[i], 100_m) > metres(grid_cell(p)) * 0.05;
      beside = beside && empty_by(square, beams[i], 100_m) < -2.2 * metres(grid_cell(p));
    }
    if (clear && covered && !is_under(p, pose, at)) wrong = "ground in a beam is vouched for";
    if (!clear && beside && by > metres(grid_cell(p)) * 0.1) wrong = "vouched ground is not clear";
  });
  return wrong;
}

/// Something has moved: the ground that it can reach is taken back, and readings clear none near an echo for
/// a second.
std::string judge_doubted(Dice& dice) {
  const Params p;
  const double cell = metres(grid_cell(p));
  const Pose pose = draw_pose(dice);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  grid.move_to(pose);
  const auto beam = [&](int deg) {
    return perception::Beam{pose.at, pose.heading + Angle::turns(deg, 360),
                            Angle::from_raw(p.rangefinders.cone.raw() / 2)};
  };
  ConeObservation seen;
  seen.taken = Time::from_raw(static_cast<std::uint32_t>(dice.bits()));
  for (int deg = -44; deg <= 44; deg += 2) {
    seen.beam = beam(deg);
    seen.free = 2_m;
    grid.mark(seen);
  }
  const LocalGrid before = grid;
  seen.beam = beam(dice.index(41) - 20);
  seen.free = millimetres(180 + dice.index(80));
  seen.hit = true;
  grid.doubt(seen, seen.free);
  if (!grid.doubting()) return "it does not doubt";
  // As far as an object comes until the body stands.
  const double stop_s = (p.rangefinders.latency + longest_gap(p) + p.wheels.motor_lag).raw() * 1e-3 +
                        2.0 / p.rangefinders.rate_hz +
                        static_cast<double>(p.wheels.max_speed.raw()) / p.wheels.max_acceleration.raw();
  const double reach = derived::kMoverSpeed.raw() * 1e-6 * stop_s, at = metres(seen.free);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec centre) {
    if (!before.is_clear(centre) || is_under(p, pose, centre)) return;
    const Vec2 off = vec(centre) - vec(pose.at);
    const double a = radians(seen.beam.axis), h = radians(seen.beam.half_cone), far = length_of(off);
    const double left = off.x * std::sin(a + h) - off.y * std::cos(a + h),
                 right = -off.x * std::sin(a - h) + off.y * std::cos(a - h);
    const double inside_by = std::min(left, right), ahead = off.x * std::cos(a) + off.y * std::sin(a);
    const bool under =
        Square::around(centre, grid_cell(p)).farthest(vec(pose.at)) < metres(rim_sweep(p).radius) + 0.002;
    if (!under && ahead > 0.01 && inside_by > -reach && far > at - reach && far < at + reach &&
        grid.is_clear(centre))
      wrong = "what moves may stand on clear ground";
    const bool out =
        inside_by < -reach - 2 * cell || far > at + reach + 3 * cell || far < at - reach - 2 * cell;
    if (out && !grid.is_clear(centre)) wrong = "a doubt takes other ground";
  });
  seen.hit = false;
  seen.free = 2_m;
  seen.taken = seen.taken + 1000_ms;
  grid.mark(seen);
  if (!grid.doubting()) return "a doubt ends too soon";
  seen.taken = seen.taken + 1_ms;
  grid.mark(seen);
  return grid.doubting() ? "a doubt does not end" : wrong;
}

/// Cells that a disc touches are suspect afterwards, except under the body.
std::string judge_block(Dice& dice) {
  const Params p;
  const Pose pose = draw_pose(dice);
  LocalGrid grid = draw_grid(dice, p, pose);
  const LocalGrid before = grid;
  const Vec at = pose.at + polar(draw_angle(dice), millimetres(60 + dice.index(150)));
  const Length radius = millimetres(1 + dice.index(40));
  grid.block(at, radius);
  std::string wrong;
  each_cell(pose.at, grid_cell(p), [&](Vec centre) {
    const double by = metres(radius) - Square::around(centre, grid_cell(p)).nearest(vec(at));
    const bool under =
        Square::around(centre, grid_cell(p)).farthest(vec(pose.at)) < metres(rim_sweep(p).radius) + 0.001;
    if (by > 0.0005 && !under && grid.is_clear(centre)) wrong = "touched ground is clear";
    const bool surely_under =
        Square::around(centre, grid_cell(p)).farthest(vec(pose.at)) < metres(rim_sweep(p).radius) - 0.001;
    if ((by < -0.001 || surely_under) && before.is_clear(centre) && !grid.is_clear(centre)) {
      wrong = "ground beside a touch is taken back";
    }
  });
  return wrong;
}

}  // namespace

std::string judge_grid_times(Dice& dice) {
  for (int i = 0; i < 6; ++i) {
    for (const JudgePart judge :
         {judge_window, judge_age, judge_revocation, judge_vouched, judge_doubted, judge_block}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
