#include "host/harness/scenario/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/check.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/events.hpp"
#include "host/harness/scenario/noise.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/robot.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/scenario/shapes.hpp"

namespace whisker {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20;

void read_places(const TableReader& start, const TableReader& goal, Scenario& s) {
  s.start.at = {start.number("x_m", kCoordinate), start.number("y_m", kCoordinate)};
  s.goal.at = {goal.number("x_m", kCoordinate), goal.number("y_m", kCoordinate)};
  s.goal.tolerance_m = goal.number_or("tolerance_m", kLength, Goal{}.tolerance_m);
  s.start.heading = start.has("heading_deg") ? start.number("heading_deg", {-360, 360}) * kRadPerDeg
                                             : bearing(s.start.at, s.goal.at);
}

/// Files often repeat the first point to close a polygon.
void drop_closing_point(std::vector<sim::Vec2>& points) {
  const bool closed = points.front().x == points.back().x && points.front().y == points.back().y;
  if (closed && points.size() > 3) points.pop_back();
}

void read_obstacles(const TableReader& top, Scenario& s) {
  if (top.has("bounds")) {
    const TableReader table = top.table("bounds", {"min", "max"});
    s.bounds = Bounds{table.point("min"), table.point("max")};
    check_bounds(table, *s.bounds);
  }
  for (const TableReader& table : top.tables("disc", {"center", "radius_m"})) {
    s.discs.push_back({table.point("center"), table.number("radius_m", kLength)});
  }
  for (const TableReader& table : top.tables("polygon", {"points"})) {
    s.polygons.push_back(table.points("points", kFewestOfPolygon, kMostPoints));
    drop_closing_point(s.polygons.back());
    check_polygon(table, s.polygons.back());
  }
  for (const TableReader& table : top.tables("wall", {"points"})) {
    s.walls.push_back(table.points("points", kFewestOfLine, kMostPoints));
  }
  for (const TableReader& table : top.tables("mover", {"center", "radius_m", "path", "speed_mps"})) {
    s.movers.push_back({table.point("center"), table.number("radius_m", kLength),
                        table.points("path", kFewestOfLine, kMostPoints),
                        table.number("speed_mps", kMoverSpeed)});
    check_mover(table, s.movers.back());
  }
}

/// A file of one kind in the other's place: without this, its first key would be unknown.
void refuse_robot_file(const toml::table& root, const std::string& file) {
  const std::vector<std::string_view> keys = keys_in_files();
  const bool parameters = std::any_of(keys.begin(), keys.end(), [&](auto key) { return root.contains(key); });
  if (root.contains("start") || root.contains("goal")) return;
  if (parameters || root.contains("robot") || root.contains("sensor"))
    throw InputError(file, 1, 1, "this is a robot file, not a scenario; give it with --robot");
}
void refuse_scenario(const toml::table& root, const std::string& file) {
  if (root.contains("start") && root.contains("goal"))
    throw InputError(file, 1, 1, "this is a scenario, not a robot file");
}

/// Throws if the disc does not hold the body.
void check_body(const RobotTables& tables, const Params& params, const Rectangle& body) {
  constexpr const char* kKey = "body_radius_m";
  constexpr double kRounding = 1e-6;
  const double has = params.body.radius.raw() * 1e-6, needed = body.radius_around_axle();
  if (has >= needed - kRounding) return;
  const bool named = tables.back().has(kKey);
  const TableReader& table = named ? tables.back() : tables.front();
  const std::string what = fmt::format(
      "body_radius_m = {}: the disc around the middle of the axle must hold the body; {} x {} m with the "
      "axle {} m behind the front need {:.3f} m",
      has, body.length, body.width, body.axle, std::ceil(needed * 1000 - kRounding) / 1000);
  throw InputErrors({named || table.has(kKey) ? table.error_at(kKey, what) : table.error(what)});
}

/// A robot file: parameters at its top level or in [robot], [sensor] and [noise].
void read_robot_file(const std::string& file, Params& params, Sensor& sensor, Noise& noise,
                     const Rectangle* body = nullptr) {
  const toml::table root = parse_toml(read_file(file), file);
  refuse_scenario(root, file);
  std::vector<std::string_view> known = keys_in_files();
  known.insert(known.end(), {"robot", "sensor", "noise"});
  const TableReader top(file, root, "", known);
  RobotTables tables{top};
  if (top.has("robot")) tables.push_back(top.table("robot", keys_in_files()));
  for (const std::string_view key : keys_in_files()) {
    if (tables.size() > 1 && top.has(key) && tables.back().has(key)) {
      tables.back().fail_at(key, fmt::format("'{}' is set both at the top level and in [robot]", key));
    }
  }
  if (top.has("sensor")) read_sensor(top.table("sensor", sensor_keys()), sensor);
  if (top.has("noise")) read_noise(top.table("noise", noise_keys()), noise);
  read_robot(tables, params);
  check_robot(tables, params);
  if (body != nullptr) check_body(tables, params, *body);
}

}  // namespace

double Rectangle::radius_around_axle() const { return std::hypot(std::fmax(axle, length - axle), width / 2); }

std::string read_file(const std::string& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream) throw InputError(file, 1, 1, fmt::format("cannot open the file: {}", std::strerror(errno)));
  std::string text;
  char block[65536];
  while (const std::size_t n = std::fread(block, 1, sizeof block, stream.get())) {
    text.append(block, n);
    if (text.size() > kMostBytes) throw InputError(file, 1, 1, "the file is larger than 16 MiB");
  }
  if (std::ferror(stream.get()) != 0) {
    throw InputError(file, 1, 1, fmt::format("cannot read the file: {}", std::strerror(errno)));
  }
  return std::string(without_mark(text, file));
}

Scenario parse_scenario(std::string_view text, const std::string& name, const std::string& robot_file) {
  const toml::table root = parse_toml(text, name);
  refuse_robot_file(root, name);
  const TableReader top(name, root, "",
                        {"name", "seed", "time_limit_s", "start", "goal", "bounds", "disc", "polygon", "wall",
                         "mover", "noise", "sensor", "robot", "event"});
  const TableReader start = top.table("start", {"x_m", "y_m", "heading_deg"});
  const TableReader goal = top.table("goal", {"x_m", "y_m", "tolerance_m"});

  Scenario s;
  s.name = top.has("name") ? top.text("name") : std::filesystem::path(name).stem().string();
  if (top.has("seed")) {
    s.seed = static_cast<std::uint64_t>(top.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  }
  s.time_limit_s = top.number_or("time_limit_s", kTimeLimit, s.time_limit_s);
  read_places(start, goal, s);
  read_obstacles(top, s);
  if (top.has("noise")) read_noise(top.table("noise", noise_keys()), s.noise);
  if (top.has("sensor")) read_sensor(top.table("sensor", sensor_keys()), s.sensor);
  if (top.has("robot")) {
    const RobotTables robot{top.table("robot", keys_in_files())};
    read_robot(robot, s.robot);
    check_robot(robot, s.robot);
  }
  s.events = read_events(top);
  if (s.bounds && !is_within(s.start.at, *s.bounds)) start.fail("the start lies outside the bounds");
  // The rest of start and goal is judged with the robot that drives.
  if (!robot_file.empty()) {
    apply_robot_file(s, robot_file);
  } else {
    check_start(start, s);
    check_goal(goal, s);
  }
  return s;
}

Scenario load_scenario(const std::string& file, const std::string& robot_file) {
  return parse_scenario(read_file(file), file, robot_file);
}

void apply_robot_file(Params& params, Sensor& sensor, const std::string& file, const Rectangle* body) {
  Params changed = params;
  Sensor changed_sensor = sensor;
  Noise ignored;
  read_robot_file(file, changed, changed_sensor, ignored, body);
  params = changed;
  sensor = changed_sensor;
}

void apply_robot_file(Params& params, const std::string& file) {
  Sensor ignored;
  apply_robot_file(params, ignored, file);
}

std::vector<std::string_view> unset_keys(const std::string& file) {
  const toml::table root = parse_toml(read_file(file), file);
  const toml::table* const own = root["robot"].as_table();
  std::vector<std::string_view> unset;
  for (const std::string_view key : robot_keys()) {
    const bool set = root.contains(key) || (own != nullptr && own->contains(key));
    if (must_set(key) && !set) unset.push_back(key);
  }
  return unset;
}

void apply_robot_file(Scenario& scenario, const std::string& file) {
  Scenario changed = scenario;
  read_robot_file(file, changed.robot, changed.sensor, changed.noise);
  std::string fault = start_fault(changed);
  if (fault.empty()) fault = tolerance_fault(changed);
  if (!fault.empty()) throw InputError(file, 1, 1, "with this robot " + fault);
  scenario.robot = changed.robot;
  scenario.sensor = changed.sensor;
  scenario.noise = changed.noise;
}

}  // namespace whisker
