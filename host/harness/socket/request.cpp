#include "host/harness/socket/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/harness/run/spec.hpp"
#include "host/harness/scenario/limits.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/robot.hpp"
#include "host/harness/sim/elementary.hpp"

namespace whisker::socket {
namespace {

using Value = nlohmann::json;

constexpr double kMostRange = hal::kMostMm / 1000.0;  // m
constexpr double kMostTime = 4294967;                 // s, in 32 bits of milliseconds
constexpr double kTooLarge = 9007199254740992;        // 2^53: a double has every whole number below it
constexpr double kDegree = sim::kPi / 180;

constexpr const char* kNotFinite[] = {"NaN", "-Infinity", "Infinity"};

bool is_not_finite(const Value& value) {
  return std::find(std::begin(kNotFinite), std::end(kNotFinite), value) != std::end(kNotFinite);
}

/// The same line with what many languages write for numbers that JSON does not have as strings.
std::string without_not_finite(const std::string& line) {
  std::string text;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t size = quoted && line[i] == '\\' ? 2 : 1;
    if (line[i] == '"') quoted = !quoted;
    bool found = false;
    for (const std::string_view name : kNotFinite) {
      if (quoted || found || line.compare(i, name.size(), name) != 0) continue;
      found = true;
      size = name.size();
    }
    text += found ? fmt::format("\"{}\"", line.substr(i, size)) : line.substr(i, size);
    i += size;
  }
  return text;
}

Value parsed(const std::string& line) {
  try {
    Value json = Value::parse(line, nullptr, false);
    if (json.is_discarded()) json = Value::parse(without_not_finite(line), nullptr, false);
    if (json.is_discarded()) json = Value::parse(line);  // where it is wrong
    if (!json.is_object()) throw ProtocolError("not a JSON object");
    return json;
  } catch (const Value::parse_error& e) {
    if (e.byte > line.size()) throw ProtocolError(fmt::format("no JSON: it ends after byte {}", line.size()));
    throw ProtocolError(fmt::format("no JSON at byte {}", e.byte));
  } catch (const Value::out_of_range&) {
    throw ProtocolError("a number is too large");
  }
}

void check_keys(const Value& object, std::string_view where, std::initializer_list<std::string_view> known) {
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end())
      throw ProtocolError(fmt::format("{}unknown key '{}'", where, item.key()));
  }
}

double number(const Value& value, std::string_view key, Limits limits) {
  if (is_not_finite(value))
    throw ProtocolError(fmt::format("'{}' must be a number, but is {}", key, value.get<std::string>()));
  if (!value.is_number()) throw ProtocolError(fmt::format("'{}' must be a number", key));
  const double x = value.get<double>();
  if (!limits.allow(x))
    throw ProtocolError(
        fmt::format("'{}' must be from {} to {}, but is {}", key, limits.low, limits.high, x));
  return x;
}

double number_in(const Value& object, const char* key, Limits limits, std::optional<double> fallback = {}) {
  if (object.contains(key)) return number(object[key], key, limits);
  if (!fallback) throw ProtocolError(fmt::format("'{}' is missing", key));
  return *fallback;
}

bool flag_in(const Value& object, const char* key) {
  if (!object.contains(key)) return false;
  if (!object[key].is_boolean()) throw ProtocolError(fmt::format("'{}' must be true or false", key));
  return object[key].get<bool>();
}

const Value& object_in(const Value& object, const char* key) {
  if (!object[key].is_object()) throw ProtocolError(fmt::format("'{}' must be an object", key));
  return object[key];
}

const Value& list_in(const Value& object, const char* key, std::size_t size) {
  const Value& list = object[key];
  if (!list.is_array() || list.size() != size)
    throw ProtocolError(fmt::format("'{}' must be a list of {} values", key, size));
  return list;
}

Goal goal_in(const Value& object) {
  const Value& goal = object_in(object, "goal");
  check_keys(goal, "goal: ", {"x_m", "y_m", "tolerance_m"});
  Goal out;
  out.at = {number_in(goal, "x_m", kCoordinate), number_in(goal, "y_m", kCoordinate)};
  out.tolerance_m = number_in(goal, "tolerance_m", kLength, out.tolerance_m);
  return out;
}

sim::Pose pose_in(const Value& object, const char* key) {
  const Value& pose = object_in(object, key);
  check_keys(pose, fmt::format("{}: ", key), {"x_m", "y_m", "heading_deg"});
  sim::Pose out{};
  out.at = {number_in(pose, "x_m", kCoordinate, 0), number_in(pose, "y_m", kCoordinate, 0)};
  out.heading = number_in(pose, "heading_deg", {-360000, 360000}, 0) * kDegree;
  return out;
}

localization::UncertainPose fix_in(const Value& object) {
  constexpr Limits kMostSigma{0, localization::PoseBound::kMost.raw() * 1e-6};
  const Value& fix = object_in(object, "fix");
  check_keys(fix,
             "fix: ", {"x_m", "y_m", "heading_deg", "sigma_along_m", "sigma_across_m", "sigma_heading_deg"});
  const Pose pose = fixed_pose({{number_in(fix, "x_m", kCoordinate), number_in(fix, "y_m", kCoordinate)},
                                number_in(fix, "heading_deg", {-360000, 360000}) * kDegree});
  const Pose sigma =
      fixed_pose({{number_in(fix, "sigma_along_m", kMostSigma), number_in(fix, "sigma_across_m", kMostSigma)},
                  number_in(fix, "sigma_heading_deg", {0, 90}) * kDegree});
  return {pose, {sigma.at.x, sigma.at.y, sigma.heading}};
}

/// 17 or 17.0: many languages write every number with a decimal point.
bool is_whole(const Value& value) {
  return value.is_number() && std::trunc(value.get<double>()) == value.get<double>();
}

/// Of a whole number.
bool fits(const Value& value) { return std::fabs(value.get<double>()) < kTooLarge; }

/// The object as the table of a robot file, so that keys, ranges and relations are those of the files.
Params robot_in(const Value& object, const Params& defaults) {
  std::string text;
  for (const auto& item : object_in(object, "robot").items()) {
    const Value& value = item.value();
    if (!value.is_number() && !value.is_boolean() && !value.is_string())
      throw ProtocolError(fmt::format("robot: '{}' must be a number, a word, true or false", item.key()));
    const Value written = is_whole(value) && fits(value) ? Value(value.get<std::int64_t>()) : value;
    text += Value(item.key()).dump() + " = " + written.dump() + "\n";
  }
  static const std::string kName = "robot";
  try {
    const toml::table table = parse_toml(text, kName);
    const RobotTables tables{TableReader(kName, table, "", keys_in_files())};
    Params params = defaults;
    read_robot(tables, params);
    check_robot(tables, params);
    return params;
  } catch (const InputError& e) {
    throw ProtocolError(e.what());
  }
}

/// With the table of `before`.
PlannerKind planner_in(const Value& object, PlannerKind before) {
  if (!object["planner"].is_string()) throw ProtocolError("'planner' must be a name");
  const auto name = object["planner"].get<std::string>();
  const auto kind = planner_named(name);
  if (!kind) throw ProtocolError(fmt::format("no planner '{}'", name));
  return {kind->number, kind->map_bytes, before.table, before.table_chosen};
}

Beam beam_of(const Value& value) {
  if (value.is_null()) return {};
  Beam beam{true, hal::RangeStatus::ok, 0, 0};
  if (value.is_string()) {
    const auto word = value.get<std::string>();
    if (word == "clear" || word == "Infinity")
      beam.status = hal::RangeStatus::clear;
    else if (word == "too_near" || word == "-Infinity")
      beam.status = hal::RangeStatus::too_near;
    else if (word == "invalid" || word == "NaN")
      beam.status = hal::RangeStatus::invalid;
    else
      throw ProtocolError(
          fmt::format("'range_m' may be a number, null, clear, too_near or invalid, but is '{}'", word));
    return beam;
  }
  const bool farther = value.is_number() && value.get<double>() > kMostRange;
  const double m = farther ? kMostRange : number(value, "range_m", {0, kMostRange});
  beam.mm = static_cast<std::uint16_t>(std::lround(m * 1000));
  return beam;
}

std::uint8_t age_of(const Value& value) {
  const double ms = number(value, "age_s", {0, kMostTime}) * 1000;
  return static_cast<std::uint8_t>(std::lround(std::min(ms, 255.0)));
}

std::int64_t whole(const Value& value, const char* key, const char* must_be = "a whole number") {
  if (!is_whole(value)) throw ProtocolError(fmt::format("'{}' must be {}", key, must_be));
  if (!fits(value)) throw ProtocolError(fmt::format("'{}' must be within 2^53", key));
  return value.get<std::int64_t>();
}

hal::GyroReading gyro_in(const Value& object) {
  const Value& gyro = object_in(object, "gyro");
  check_keys(gyro, "gyro: ", {"sum", "samples", "saturated"});
  const auto counter = [&](const char* key) {
    if (!gyro.contains(key)) throw ProtocolError(fmt::format("gyro: '{}' is missing", key));
    return whole(gyro[key], key);
  };
  return {static_cast<std::uint32_t>(counter("sum")), static_cast<std::uint16_t>(counter("samples")),
          static_cast<std::uint16_t>(gyro.contains("saturated") ? counter("saturated") : 0)};
}

hal::BumperReading bumper_in(const Value& object) {
  constexpr const char* kNames[] = {"left", "front", "right"};
  if (!object["pressed"].is_array()) throw ProtocolError("'pressed' must be a list");
  hal::BumperReading reading{};
  for (const Value& value : object["pressed"]) {
    const auto* const found = std::find(std::begin(kNames), std::end(kNames), value);
    if (found == std::end(kNames)) throw ProtocolError("'pressed' may name left, front and right");
    reading.pressed = static_cast<std::uint8_t>(reading.pressed | 1 << (found - std::begin(kNames)));
  }
  return reading;
}

}  // namespace

Opening read_opening(const std::string& line, const Opening& defaults) {
  const Value json = parsed(line);
  if (!json.contains("whisker")) throw ProtocolError("the first line must have the key 'whisker'");
  if (json["whisker"] != kProtocol)
    throw ProtocolError(fmt::format("this is version {} of the protocol", kProtocol));
  check_keys(json, "", {"whisker", "robot", "planner", "start", "goal"});
  Opening out = defaults;
  if (json.contains("robot")) out.robot = robot_in(json, defaults.robot);
  if (json.contains("planner")) out.planner = planner_in(json, defaults.planner);
  if (json.contains("start")) out.start = pose_in(json, "start");
  if (json.contains("goal")) out.goal = goal_in(json);
  return out;
}

Tick read_tick(const std::string& line) {
  const Value json = parsed(line);
  check_keys(
      json, "",
      {"t_s", "range_m", "age_s", "counts", "pressed", "gyro", "reset", "cancel", "place", "fix", "goal"});
  Tick out;
  if (json.contains("t_s"))
    out.now_ms = static_cast<std::uint32_t>(std::llround(number(json["t_s"], "t_s", {0, kMostTime}) * 1000));
  if (json.contains("range_m")) {
    const Value& list = list_in(json, "range_m", hal::kBeams);
    out.has_ranges = true;
    for (std::size_t i = 0; i < hal::kBeams; ++i) out.beam[i] = beam_of(list[i]);
  }
  if (json.contains("age_s")) {
    const bool each = json["age_s"].is_array();
    if (each) list_in(json, "age_s", hal::kBeams);
    for (std::size_t i = 0; i < hal::kBeams; ++i)
      out.beam[i].age_ms = age_of(each ? json["age_s"][i] : json["age_s"]);
  }
  if (json.contains("counts")) {
    const Value& list = list_in(json, "counts", 2);
    const bool failed = is_not_finite(list[0]) || is_not_finite(list[1]);
    const auto count = [&](std::size_t side) { return whole(list[side], "counts", "whole numbers"); };
    if (!failed) out.counts = {count(0), count(1)};
  }
  if (json.contains("pressed")) out.bumper = bumper_in(json);
  if (json.contains("gyro")) out.gyro = gyro_in(json);
  out.reset = flag_in(json, "reset");
  out.cancel = flag_in(json, "cancel");
  if (json.contains("place")) out.place = pose_in(json, "place");
  if (json.contains("fix")) out.fix = fix_in(json);
  if (json.contains("goal")) out.goal = goal_in(json);
  return out;
}

}  // namespace whisker::socket
