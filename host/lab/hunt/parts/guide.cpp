// The advice of the map, for a body that the judge moves.
#include <cmath>

#include "firmware/planning/global/map_planner.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using planning::View;
using Advice = planning::GlobalPlanner::Advice;

double degrees(Angle a) { return radians(a) * 180 / sim::kPi; }

/// A guide whose body the judge moves.
struct Guided {
  Params p;
  perception::LocalGrid grid;
  View view;
  planning::MapOf<2048> map{p};
  Vec goal;
  Guided(Dice& dice, double far) {
    grid.configure(p);
    grid.reset({});
    view.local_grid = &grid;
    view.travelled_um = static_cast<std::uint32_t>(dice.bits());
    goal = polar(draw_angle(dice), micrometres(static_cast<std::int32_t>(far * 1e6)));
    map.guide.start(view, {goal, 100_mm});
  }
  void stay(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }
  void tick() {
    map.guide.observe(view);
    map.guide.ponder(view);
  }
  Advice advice(Vec& place) { return map.guide.advise(view, norm(goal - view.pose.at), place); }
  Advice advice() {
    Vec place;
    return advice(place);
  }
  void go_to(Vec at) {
    view.travelled_um += static_cast<std::uint32_t>(norm(at - view.pose.at).raw());
    view.pose.at = at;
    grid.move_to(view.pose);
    tick();
  }
  /// Walls all round, or up to this angle.
  void see_ring(int degrees_of_it, int from) {
    view.observed = 1;
    for (int deg = 0; deg < degrees_of_it; deg += 5) {
      const Pose eye{view.pose.at, Angle::turns((deg + from) % 360, 360)};
      view.observations[0] = {perception::beam_of(mount(p.rangefinders, hal::kFront), eye), 0, 250_mm, true};
      stay(1);
    }
    view.observed = 0;
    stay(150);
  }
  std::int32_t dither(std::int32_t most_mm, Advice until) {
    const Vec from = view.pose.at;
    for (std::int32_t way = 0; way < most_mm; way += 5) {
      go_to(from - Vec{millimetres(way / 5 % 2 == 0 ? 5 : 0), Length{}});
      if (advice() == until) return way;
    }
    return most_mm;
  }
};

}  // namespace

std::string judge_guide(Dice& dice) {
  const double far = dice.uniform(1.2, 2.4);
  Guided g(dice, far);
  if (g.advice() != Advice::none) return "advice before a plan";
  g.stay(60);
  Vec place;
  if (g.advice(place) != Advice::place) return "no advice after a plan";
  if (std::fabs(radians(bearing(place) - bearing(g.goal))) > 0.3) return "the open way is another one";
  const int kind = dice.index(4);
  if (kind == 0) {
    // Round what stands between.
    const int from = static_cast<int>(std::lround(degrees(bearing(g.goal)))) + 360 - 60;
    g.see_ring(125, from);
    if (g.map.guide.knows_no_way()) return "no way round a part of a ring";
    if (g.advice(place) != Advice::place) return "no advice round a wall";
    return std::fabs(radians(bearing(place) - bearing(g.goal))) > 0.5 ? "" : "the way leads through a wall";
  }
  if (kind == 1) {
    g.see_ring(360, 0);
    if (!g.map.guide.knows_no_way() || g.advice() != Advice::none) return "a way out of a ring";
    return g.map.guide.doubt() ? "a doubt without need" : "";
  }
  if (kind == 2) {
    if (std::abs(g.dither(25000, Advice::none) - 20000) > 20)
      return "advice without progress has another end";
    g.go_to(g.view.pose.at + polar(bearing(g.goal - g.view.pose.at), 300_mm));
    g.stay(60);
    if (g.advice() != Advice::place) return "no advice after progress";
    return std::abs(g.dither(25000, Advice::none) - 10000) > 20 ? "the second spell has another length" : "";
  }
  if (!g.map.guide.doubt() || g.map.guide.doubt()) return "it does not doubt once";
  if (!g.map.guide.knows_no_way()) return "a last try is none";
  g.stay(60);
  if (g.advice() != Advice::place) return "no advice for a last try";
  return std::abs(g.dither(12000, Advice::no_way) - 8000) > 20 ? "a last try has another length" : "";
}

}  // namespace whisker::hunt
