#include "host/worlds/generate.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "host/scenario/bearing.hpp"
#include "host/scenario/contact.hpp"
#include "host/scenario/world.hpp"
#include "host/worlds/draw.hpp"
#include "host/worlds/reach.hpp"

namespace whisker::worlds {
namespace {

constexpr int kMostDraws = 1000;
constexpr int kMostDiscs = 200;

bool has_discs(Kind kind) { return kind != Kind::u_trap && kind != Kind::spiral && kind != Kind::maze; }
bool has_box(Kind kind) { return has_discs(kind) && kind != Kind::rooms; }

void check(Kind kind, const Options& o) {
  if (o.seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    throw std::invalid_argument("the seed must be less than 2^63");
  }
  if (o.discs && !has_discs(kind)) throw std::invalid_argument(fmt::format("{} has no discs", name(kind)));
  if (o.discs && (*o.discs < 0 || *o.discs > kMostDiscs)) {
    throw std::invalid_argument(fmt::format("discs must be from 0 to {}, but is {}", kMostDiscs, *o.discs));
  }
  if (o.wheel_scale_sigma) {
    if (!o.noise) throw std::invalid_argument("a scale error of the wheels needs noise");
    if (!(*o.wheel_scale_sigma >= 0 && *o.wheel_scale_sigma <= 1)) {
      throw std::invalid_argument("the scale error of the wheels must be from 0 to 1");
    }
  }
  if (o.box && !has_box(kind)) throw std::invalid_argument(fmt::format("{} has no box", name(kind)));
}

void draw(Kind kind, Scenario& scenario, Random& random, const Options& options) {
  switch (kind) {
    case Kind::discs: return draw_discs(scenario, random, options);
    case Kind::poles: return draw_poles(scenario, random, options);
    case Kind::u_trap: return draw_u_trap(scenario, random);
    case Kind::spiral: return draw_spiral(scenario, random);
    case Kind::maze: return draw_maze(scenario, random);
    case Kind::rooms: return draw_rooms(scenario, random, options);
    case Kind::enclosed: return draw_enclosed(scenario, random, options);
  }
}

bool keeps_promise(Kind kind, const Scenario& s) {
  if (!start_fault(s).empty()) return false;
  const World world = make_world(s);
  if (kind == Kind::enclosed) {
    return path_ruled_out(world, s.start.at, s.goal.at, s.goal.tolerance_m, kShutRadius);
  }
  return path_proven(world, s.start.at, s.goal.at, kPassableRadius);
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

Scenario generate(Kind kind, const Options& options) {
  check(kind, options);
  // Different kinds with one seed share no numbers: the seed is stirred with the kind first.
  Random random(Random(options.seed).bits() + static_cast<std::uint64_t>(kind));
  for (int i = 0; i < kMostDraws; ++i) {
    Scenario s;
    draw(kind, s, random, options);
    if (!keeps_promise(kind, s)) continue;
    s.name =
        fmt::format("{}{}{}{}, seed {}", name(kind), options.discs ? fmt::format(" {}", *options.discs) : "",
                    options.box ? " in a box" : "", options.noise ? " with noise" : "", options.seed);
    s.seed = options.seed;
    s.time_limit_s = kTimeLimit;
    s.start.heading = bearing(s.start.at, s.goal.at);
    if (options.noise) s.noise = reference_noise(options);
    return s;
  }
  throw std::runtime_error(fmt::format("{} draws gave no {} world with {}", kMostDraws, name(kind),
                                       kind == Kind::enclosed ? "its goal shut in" : "a path to its goal"));
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::discs: return "discs";
    case Kind::poles: return "poles";
    case Kind::u_trap: return "u-trap";
    case Kind::spiral: return "spiral";
    case Kind::maze: return "maze";
    case Kind::rooms: return "rooms";
    case Kind::enclosed: return "enclosed";
  }
  return "?";
}

std::optional<Kind> kind_named(std::string_view text) {
  for (const Kind kind : kKinds) {
    if (text == name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace whisker::worlds
