#include "host/harness/worlds/kept.hpp"

#include <algorithm>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/nearest.hpp"
#include "host/harness/scenario/world.hpp"
#include "host/harness/worlds/draw.hpp"
#include "host/harness/worlds/reach.hpp"

namespace whisker::worlds {
namespace {

void draw(Kind kind, Scenario& scenario, Random& random, const Options& options) {
  switch (kind) {
    case Kind::discs: return draw_discs(scenario, random, options);
    case Kind::poles: return draw_poles(scenario, random, options);
    case Kind::u_trap: return draw_u_trap(scenario, random);
    case Kind::spiral: return draw_spiral(scenario, random);
    case Kind::maze: return draw_maze(scenario, random);
    case Kind::rooms: return draw_rooms(scenario, random, options);
    case Kind::enclosed: return draw_enclosed(scenario, random, options);
    case Kind::enclosed_at_wall: return draw_enclosed_at_wall(scenario, random, options);
    case Kind::gap_at_wall: return draw_gap_at_wall(scenario, random, options);
    case Kind::contest_maze: return draw_contest_maze(scenario, random);
    case Kind::gap: return draw_gap(scenario, random, options);
    case Kind::disc_gap: return draw_disc_gap(scenario, random, options);
  }
}

bool keeps_promise(Kind kind, const Scenario& s, const Options& o) {
  if (!start_is_free(s)) return false;
  const World world = make_world(s);
  if (has_no_way(kind)) {
    return path_ruled_out(world, s.start.at, s.goal.at, s.goal.tolerance_m, kShutRadius);
  }
  const double radius = std::min(kPassableRadius, o.gap_m.value_or(kGap) / 2 - kPathBand);
  return path_proven(world, s.start.at, s.goal.at, radius);
}

Noise reference_noise(const Options& o) {
  Noise n;
  n.range_sigma_m = 0.01;
  n.range_dropout = 0.02;
  n.range_false_clear = 0.01;
  n.wheel_scale_sigma = o.wheel_scale_sigma.value_or(0.0001);
  n.heading_drift_deg_per_sqrt_m = 0.3;
  return n;
}

}  // namespace

std::optional<Scenario> first_kept(Kind kind, const Options& options) {
  // The kind is mixed into the seed first, so that kinds with the same seed share no numbers.
  Random random(Random(options.seed).bits() + static_cast<std::uint64_t>(kind));
  for (int i = 0; i < kMostDraws; ++i) {
    Scenario s;
    draw(kind, s, random, options);
    if (!keeps_promise(kind, s, options)) continue;
    s.seed = options.seed;
    s.time_limit_s = kTimeLimit;
    s.start.heading = bearing(s.start.at, s.goal.at);
    if (options.noise) s.noise = reference_noise(options);
    return s;
  }
  return std::nullopt;
}

}  // namespace whisker::worlds
