/// The functions that host/lab/web/src/playground/core.ts calls. Data other than single numbers passes
/// through a list in memory: `list` allocates it, and functions that return a length fill it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/fuzzy/digest.hpp"
#include "firmware/fuzzy/generate.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "host/harness/run/clear_cells.hpp"
#include "host/harness/scenario/nearest.hpp"
#include "host/harness/worlds/kept.hpp"
#include "host/lab/play/drive.hpp"
#include "host/lab/play/exports.hpp"
#include "host/lab/play/flat.hpp"
#include "host/lab/play/guard_drive.hpp"
#include "host/lab/play/rule_faults.hpp"
#include "host/lab/play/table_of.hpp"
#include "host/lab/report/track.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::play {

std::vector<double> exchanged;
std::unique_ptr<SimulatedRobot> robots[kSides];

namespace {

fuzzy::RuleBase rules = fuzzy::kRules;
fuzzy::Bilinear::Table table = fuzzy::kResponseTable;
/// The one of them that the user drives, if there is one.
GuardDrive* driven = nullptr;

double value(Q14 x) { return x.raw() / 16384.0; }
double metres(Length x) { return x.raw() / 1e6; }
double half_turns(Angle x) { return x.wrapped() / 2147483648.0; }

/// The core's planner with this number, with the default size of map if it has one.
PlannerKind offered(int number) {
  PlannerKind kind;
  planning::for_each_planner([&](const planning::PlannerInfo& info, auto type) {
    const bool usual = type.kMapBytes == 0 || type.kMapBytes == planning::kUsualMapBytes;
    if (info.number == number && usual) kind = {number, type.kMapBytes};
  });
  return kind;
}

/// Its name or its description; null if no planner has this number.
const char* planner_word(int number, const char* planning::PlannerInfo::*word) {
  const char* found = nullptr;
  planning::for_each_planner([&](const planning::PlannerInfo& info, auto) {
    if (info.number == number) found = info.*word;
  });
  return found;
}

GuardDrive::Switches switches(int guarded, int nods, int assist) {
  return {guarded != 0, nods != 0, assist != 0};
}

int answer() { return static_cast<int>(exchanged.size()); }

/// Samples over the table's range: quarters of a unit over all of D and of R.
constexpr int kSamples = 4;
constexpr int kRows = 10 * kSamples;
constexpr int kColumns = 16 * kSamples;

}  // namespace

WHISKER_EXPORT(list) double* list(int count) {
  exchanged.resize(static_cast<std::size_t>(count));
  return exchanged.data();
}

/// Writes a scenario of this kind in the format of flat(); 0 if there is none.
WHISKER_EXPORT(generate) int generate(int kind, double seed, int discs, int box, int noise) {
  worlds::Options options;
  options.seed = static_cast<std::uint64_t>(seed);
  if (discs >= 0) options.discs = discs;
  options.box = box != 0;
  options.noise = noise != 0;
  const std::optional<Scenario> scenario = worlds::first_kept(worlds::kKinds[kind], options);
  if (!scenario) return 0;
  exchanged = flat(*scenario);
  return answer();
}

/// 0: the list is a valid scenario; 1: it is not; 2: the robot touches an obstacle at its start.
WHISKER_EXPORT(judge) int judge() {
  const std::optional<Scenario> scenario = scenario_of(exchanged);
  if (!scenario) return 1;
  return start_is_free(*scenario) ? 0 : 2;
}

/// Restarts the robot on this side in the scenario in the list; planner: its number, see word().
WHISKER_EXPORT(begin) int begin(int side, int planner) {
  std::optional<Scenario> scenario = scenario_of(exchanged);
  if (!scenario) return 0;
  if (side == 0) driven = nullptr;
  robots[side] = std::make_unique<Drive>(*scenario, offered(planner), table);
  return 1;
}

/// The same for a robot that the user drives. It must be the only one; begin() ends its drive.
WHISKER_EXPORT(begin_guard) int begin_guard(int guarded, int nods, int assist) {
  const std::optional<Scenario> scenario = scenario_of(exchanged);
  if (!scenario) return 0;
  auto robot = std::make_unique<GuardDrive>(*scenario, switches(guarded, nods, assist), table);
  driven = robot.get();
  robots[0] = std::move(robot);
  return 1;
}

WHISKER_EXPORT(set_guard) void set_guard(int guarded, int nods, int assist) {
  driven->set(switches(guarded, nods, assist));
}

/// The asked velocity, m/s and rad/s.
WHISKER_EXPORT(command) void command(double forward, double turning) { driven->command({forward, turning}); }

/// Whether the guard is on, its reason, the asked velocity and the granted shares.
WHISKER_EXPORT(grant) int grant() {
  const guard::GuardedBody& body = driven->body();
  exchanged = {0, 0, body.asked().forward_mps, body.asked().turning_radps, 1, 1};
  if (!body.wiring().guarded) return answer();
  const GuardStatus& s = body.status();
  exchanged = {1,
               static_cast<double>(s.reason),
               s.asked.forward.raw() / 1e6,
               s.asked.turning.raw() / 1e6,
               value(s.forward),
               value(s.turning)};
  return answer();
}

WHISKER_EXPORT(change) int change(int side) {
  const std::optional<Scenario> scenario = scenario_of(exchanged);
  if (!scenario) return 0;
  robots[side]->change(*scenario);
  return 1;
}

WHISKER_EXPORT(advance) void advance(int side, int ticks) { robots[side]->advance(ticks); }

/// The columns of the trace, in the order of core.ts.
WHISKER_EXPORT(record) int record(int side) {
  const SimulatedRobot& robot = *robots[side];
  const TickRecord r = robot.record();
  const localization::PoseSigma sigma = r.sigma.value_or(localization::PoseSigma{});
  exchanged = {r.t_s,
               r.x_m,
               r.y_m,
               r.heading_rad,
               r.est_x_m,
               r.est_y_m,
               r.est_heading_rad,
               r.v_left_mps,
               r.v_right_mps,
               static_cast<double>(r.mode),
               static_cast<double>(r.why),
               static_cast<double>(report::doing(r)),
               static_cast<double>(r.danger_count),
               r.d_q7 / 128.0,
               r.r_q7 / 128.0,
               r.sa_q14 / 16384.0,
               r.sd_q14 / 16384.0,
               static_cast<double>(r.cell.distance),
               static_cast<double>(r.cell.bias),
               static_cast<double>(robot.fault()),
               static_cast<double>(r.guide),
               r.way_x_m,
               r.way_y_m,
               report::metres(sigma.along),
               report::metres(sigma.across),
               report::radians(sigma.heading),
               report::metres(robot.grid_pose().at.x),
               report::metres(robot.grid_pose().at.y),
               report::radians(robot.grid_pose().heading)};
  for (const hal::RangeReading& reading : r.ranges.beam) {
    exchanged.push_back(reading.mm / 1000.0);
    exchanged.push_back(static_cast<double>(reading.status));
  }
  exchanged.push_back(r.bend_rad);
  exchanged.push_back(r.pace_mps);
  return answer();
}

/// Verdict or -1, time, path length, distance from the goal, true and believed, clearance, ticks, and the
/// hash in four 16-bit parts, highest first.
WHISKER_EXPORT(result) int result(int side) {
  const SimulatedRobot& robot = *robots[side];
  const RunResult r = robot.result();
  exchanged = {robot.over() ? static_cast<double>(r.verdict) : -1.0,
               r.time_s,
               r.path_m,
               r.final_distance_m,
               r.believed_distance_m.value_or(-1.0),
               r.min_clearance_m,
               static_cast<double>(r.ticks)};
  for (int shift = 48; shift >= 0; shift -= 16)
    exchanged.push_back(static_cast<double>(static_cast<std::uint16_t>(r.hash >> shift)));
  return answer();
}

/// The path from this index on: x, y, class.
WHISKER_EXPORT(way) int way(int side, int from) {
  const std::vector<SimulatedRobot::Passed>& all = robots[side]->way();
  exchanged.clear();
  for (std::size_t i = static_cast<std::size_t>(from); i < all.size(); ++i) {
    exchanged.insert(exchanged.end(), {all[i].at.x, all[i].at.y, static_cast<double>(all[i].kind)});
  }
  return answer();
}

/// The positions of the clear cells, in cells of the world; empty without a local grid.
WHISKER_EXPORT(clear_cells) int clear_cells(int side) {
  const SimulatedRobot& robot = *robots[side];
  exchanged.clear();
  const perception::LocalGrid* local_grid = robot.local_grid();
  if (local_grid == nullptr) return 0;
  for_each_clear_cell(*local_grid, robot.params(), robot.grid_pose().at, [](std::int64_t x, std::int64_t y) {
    exchanged.insert(exchanged.end(), {static_cast<double>(x), static_cast<double>(y)});
  });
  return answer();
}

/// The map size of the planner on this side; 0 without a map.
WHISKER_EXPORT(map_bytes) int map_bytes(int side) { return robots[side]->map_bytes(); }

/// Columns, rows, cell side, first cell of the window, the state of each cell row by row, and the points of
/// the planned path; empty without a map.
WHISKER_EXPORT(map) int map_cells(int side) {
  const std::optional<MapPicture>& picture = robots[side]->map();
  exchanged.clear();
  if (!picture) return 0;
  exchanged = {static_cast<double>(picture->columns), static_cast<double>(picture->rows), picture->cell_m,
               static_cast<double>(picture->corner.x), static_cast<double>(picture->corner.y)};
  for (const planning::CellState state : picture->cells) exchanged.push_back(static_cast<double>(state));
  for (const planning::Cell p : picture->way)
    exchanged.insert(exchanged.end(), {static_cast<double>(p.x), static_cast<double>(p.y)});
  return answer();
}

/// Of the robot on this side, or of the reference robot: radius, track, top speed, side angle and cone in
/// half turns, minimum and maximum range, offset, cell, base turn in half turns, period.
WHISKER_EXPORT(robot) int robot(int side) {
  const Params p = side >= 0 ? robots[side]->params() : Params{};
  exchanged = {metres(p.body.radius),
               metres(p.body.track),
               p.wheels.max_speed.raw() / 1e6,
               half_turns(p.rangefinders.side_angle),
               half_turns(p.rangefinders.cone),
               metres(p.rangefinders.min_range),
               metres(p.rangefinders.max_range),
               metres(p.rangefinders.offset),
               metres(grid_cell(p)),
               half_turns(derived::kBaseTurn),
               p.safety.period.raw() / 1000.0};
  return answer();
}

/// The 25 turns, then the 25 steps, as raw numbers.
WHISKER_EXPORT(get_rules) int get_rules() {
  exchanged.clear();
  for (const auto* picture : {&rules.turn, &rules.step})
    for (const auto& row : *picture)
      for (const Q14 q : row) exchanged.push_back(q.raw());
  return answer();
}

/// Sets the rules from the list and rebuilds the table. Returns the faults of rule_faults().
WHISKER_EXPORT(set_rules) std::uint32_t set_rules() {
  const double* next = exchanged.data();
  for (auto* picture : {&rules.turn, &rules.step})
    for (auto& row : *picture)
      for (Q14& q : row) q = Q14::from_raw(static_cast<std::int16_t>(*next++));
  fuzzy::generate<fuzzy::Bilinear>(rules, table);
  return rule_faults(rules);
}

WHISKER_EXPORT(at_fault) int at_fault(int d, int r) { return rule_at_fault(rules, d, r) ? 1 : 0; }

/// Replaces the table, until set_rules(), by the nodes in the list. 0: done. Otherwise nothing has changed,
/// and 1: these are not the nodes of a table, 2: they do not have this hash.
WHISKER_EXPORT(set_table) int set_table(std::uint32_t hash) {
  const std::optional<fuzzy::Bilinear::Table> next = table_of(exchanged);
  if (!next) return 1;
  if (fuzzy::digest(*next) != hash) return 2;
  table = *next;
  return 0;
}

/// Distance nodes, bias nodes, their spacings, and both outputs of each node, as raw numbers.
WHISKER_EXPORT(get_table) int get_table() {
  using fuzzy::Bilinear;
  exchanged = {Bilinear::kDistanceNodes, Bilinear::kBiasNodes, Bilinear::kDistanceSpacing,
               Bilinear::kBiasSpacing};
  for (const auto& row : table.node)
    for (const Bilinear::Node& node : row)
      exchanged.insert(exchanged.end(), {double(node.turn), double(node.step)});
  return answer();
}

/// Turn and step in thousandths, over all of D and, within, over all of R, in quarters of a unit.
WHISKER_EXPORT(sample_table) int sample_table() {
  exchanged.clear();
  const fuzzy::Bilinear engine(table);
  for (int i = 0; i <= kRows; ++i) {
    for (int j = 0; j <= kColumns; ++j) {
      const auto d = static_cast<std::int16_t>(i * 128 / kSamples);
      const auto r = static_cast<std::int16_t>(j * 128 / kSamples - 8 * 128);
      const fuzzy::Response at = engine({Q7::from_raw(d), Q7::from_raw(r)});
      exchanged.insert(exchanged.end(), {value(at.turn) * 1000, value(at.step) * 1000});
    }
  }
  return answer();
}

/// Word i of a list: 0 states, 1 reasons, 2 faults, 3 kinds of worlds, 4 map states, 5 planners, 6
/// descriptions of the planners, 7 reasons of the guard. Null beyond its end.
WHISKER_EXPORT(word) const char* word(int which, int i) {
  switch (which) {
    case 0: return i < planning::kModes ? planning::name(static_cast<planning::Mode>(i)) : nullptr;
    case 1: return i < planning::kWhys ? planning::name(static_cast<planning::Why>(i)) : nullptr;
    case 2: return i < kFaults ? name(static_cast<Fault>(i)) : nullptr;
    case 3: return i < static_cast<int>(std::size(worlds::kKinds)) ? name(worlds::kKinds[i]) : nullptr;
    case 4: return i < kGuidances ? name(static_cast<Guidance>(i)) : nullptr;
    case 5: return planner_word(i, &planning::PlannerInfo::name);
    case 6: return planner_word(i, &planning::PlannerInfo::about);
    case 7: return i < kGuardReasons ? name(static_cast<GuardReason>(i)) : nullptr;
    default: return nullptr;
  }
}

}  // namespace whisker::play
