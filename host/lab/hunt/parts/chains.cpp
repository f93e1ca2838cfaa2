// Chains of readings: what they clear is free, and a turn on the spot clears the rim.
#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using perception::ConeObservation;
using perception::LocalGrid;

/// Bodies of several sizes, at whose rim no single reading covers a cell.
Params draw_robot(Dice& dice) {
  while (true) {
    Params p;
    p.body.radius = millimetres(20 + dice.index(130));
    p.body.margin = millimetres(dice.index(30));
    p.body.track = p.body.radius * 3 / 2;
    if (dice.chance(0.5)) p.wheels.counts_per_metre = 1000000;
    RangefinderParams& r = p.rangefinders;
    r.max_range = millimetres(500 + dice.index(1500));
    r.cone = Angle::turns(100 + dice.index(300), 3600);
    r.side_angle = Angle::turns(50 + dice.index(800), 3600);
    if (dice.chance(0.5))
      r.offset = Length::from_raw(static_cast<std::int32_t>(p.body.radius.raw() * dice.uniform(0, 1.3)));
    if (check(p) == ParamFault::none && rim_sweep(p).needed) return p;
  }
}

/// One beam, from exact readings to the grid.
struct Eye {
  perception::EarlierObservation last;
  bool has_last = false;
  void see(const ConeObservation& seen, LocalGrid& grid) {
    const perception::EarlierObservation* const before = seen.hit ? nullptr : &last;
    if (seen.hit || has_last) {
      grid.mark(seen, before);
      grid.chain(seen, before);
    }
    last = {seen.beam.apex, seen.beam.axis, seen.free};
    has_last = true;
  }
};

std::string judge_free(Dice& dice) {
  const Params p = draw_robot(dice);
  Pose pose{{micrometres(dice.index(1000000) - 500000), micrometres(dice.index(1000000) - 500000)},
            draw_angle(dice)};
  const double free_m = metres(rim_sweep(p).radius) + 1e-6;
  const Clutter world = draw_clutter(dice, p, pose, free_m);
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  Eye eyes[3];
  Time now;
  const double cone = 2 * radians(mount(p.rangefinders, dice.index(3)).half_cone);
  const double turn = dice.uniform(-1.1, 1.1) * cone;
  for (int i = 5 + dice.index(30); i > 0; --i) {
    Pose next = pose;
    next.heading += Angle::from_raw(
        static_cast<std::uint32_t>(std::llround(turn * dice.uniform(0.3, 1.2) / (2 * sim::kPi) * 0x1p32)));
    if (dice.chance(0.2))
      next.at = pose.at + polar(next.heading, Length::from_raw(static_cast<std::int32_t>(
                                                  dice.uniform(-0.1, 0.1) * p.body.radius.raw())));
    if (!world.reaches(vec(next.at), free_m)) pose = next;
    grid.move_to(pose);
    for (int beam = 0; beam < 3; ++beam) {
      ConeObservation seen = look(p, world, pose, beam);
      seen.taken = now;
      eyes[beam].see(seen, grid);
    }
    now = now + milliseconds(dice.chance(0.02) ? 460 : 50);
  }
  bool hidden = false;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    hidden = hidden || (grid.is_clear(at) && Square::around(at, grid_cell(p)).covered(world, 1e-6));
  });
  return hidden ? "an obstacle stands on chained ground" : "";
}

std::string judge_rim(Dice& dice) {
  Params p = draw_robot(dice);
  p.rangefinders.rate_hz = 5 + dice.index(96);
  p.conditioning.stale_after = 500_ms;
  const double side = metres(grid_cell(p)), outer = metres(rim_sweep(p).radius) + 2 * side;
  if (check(p) != ParamFault::none) return "";
  Pose pose{{micrometres(dice.index(100000)), micrometres(dice.index(100000))}, draw_angle(dice)};
  LocalGrid grid;
  grid.configure(p);
  grid.reset(pose);
  Eye eyes[3];
  const double step = turn_rate(p).raw() * 1e-6 / p.rangefinders.rate_hz * (dice.chance(0.5) ? 1 : -1);
  Time now;
  for (double turned = 0; turned < 2.5 * sim::kPi; turned += std::fabs(step)) {
    pose.heading += Angle::from_raw(static_cast<std::uint32_t>(std::llround(step / (2 * sim::kPi) * 0x1p32)));
    grid.move_to(pose);
    for (int beam = 0; beam < 3; ++beam) {
      ConeObservation seen = look(p, {}, pose, beam);
      seen.taken = now;
      eyes[beam].see(seen, grid);
    }
    now = now + milliseconds(1000 / p.rangefinders.rate_hz);
  }
  bool missed = false;
  each_cell(pose.at, grid_cell(p), [&](Vec at) {
    const bool near = Square::around(at, grid_cell(p)).nearest(vec(pose.at)) <= outer;
    missed = missed || (near && !grid.is_clear(at));
  });
  return missed ? "a turn on the spot leaves ground at the rim unseen" : "";
}

}  // namespace

std::string judge_chains(Dice& dice) {
  for (int i = 0; i < 6; ++i) {
    std::string wrong = judge_free(dice);
    if (wrong.empty()) wrong = judge_rim(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
