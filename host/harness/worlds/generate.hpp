/// Random worlds for tests and campaigns. The same options give the same world on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "host/harness/scenario/scenario.hpp"

namespace whisker::worlds {

enum class Kind {
  discs,             ///< 30 discs of radius 0.15..0.8 m between (0, 0) and (8, 8)
  poles,             ///< 12 such discs and 100 poles of radius 1..3 cm
  u_trap,            ///< a U open towards the start, with the goal behind it; one start in three lies inside
  spiral,            ///< a square spiral, nested U's that open to opposite sides, or a G with lips
  maze,              ///< 5..8 cells a side, up to 30 % of the walls removed
  rooms,             ///< 3 x 3 rooms with doors of 0.3..0.6 m, and 4 discs
  enclosed,          ///< no path: a fence around start or goal, or the goal inside a disc
  enclosed_at_wall,  ///< no path: discs in a box, and a fence around the goal that crosses the box
  gap_at_wall,       ///< the same with a gap of 0.26..0.6 m in the fence
  contest_maze,      ///< 32 x 32 cells of 0.54 m, up to 30 % of the walls removed, the goal in the middle
  gap,               ///< a wall across a box, with one gap between start and goal
  disc_gap,          ///< the same between two discs of radius 0.2 m in that wall
};
/// The classes that every planner is measured in.
constexpr Kind kKinds[] = {Kind::discs, Kind::poles, Kind::u_trap,  Kind::spiral,
                           Kind::maze,  Kind::rooms, Kind::enclosed};
constexpr Kind kAllKinds[] = {Kind::discs,       Kind::poles,        Kind::u_trap,   Kind::spiral,
                              Kind::maze,        Kind::rooms,        Kind::enclosed, Kind::enclosed_at_wall,
                              Kind::gap_at_wall, Kind::contest_maze, Kind::gap,      Kind::disc_gap};
/// The goal is out of reach.
constexpr bool has_no_way(Kind kind) { return kind == Kind::enclosed || kind == Kind::enclosed_at_wall; }

struct Options {
  std::uint64_t seed = 1;  ///< below 2^63
  /// Number of discs; kinds without discs (u_trap, spiral, mazes) refuse it. At most 200.
  std::optional<int> discs;
  bool box = false;    ///< discs, poles and enclosed: a closed box around, and radii of at most 0.6 m
  bool noise = false;  ///< the reference robot's sensor and odometry noise
  /// Of each wheel's encoder, instead of the reference robot's: 0 to 1; only with noise.
  std::optional<double> wheel_scale_sigma = std::nullopt;
  /// Width of the gap, m: kGapMin to kGapMax; only for gap and disc_gap, by default kGap.
  std::optional<double> gap_m = std::nullopt;
};

constexpr double kGap = 0.32;
constexpr double kGapMin = 0.16;  ///< so that a body with the radius kGapMin / 2 - kPathBand has a path
constexpr double kGapMax = 1;

/// m; in every kind with a path, a body of this radius has a path, except through a gap_m below the default
constexpr double kPassableRadius = 0.125;
constexpr double kShutRadius = 0.085;  ///< m; an enclosed goal is out of reach even for a body of this radius
constexpr double kKeptFree = 0.25;     ///< m from start and goal to the surface of any random disc
constexpr double kTimeLimit = 1800;    ///< s

/// Throws std::invalid_argument for options that the kind does not have, and std::runtime_error if 1000 draws
/// give no world with the properties of the kind.
Scenario generate(Kind kind, const Options& options);

/// As on the command line: "u-trap".
const char* name(Kind kind);
std::optional<Kind> kind_named(std::string_view name);

}  // namespace whisker::worlds
