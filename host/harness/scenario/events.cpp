#include "host/harness/scenario/events.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/robot.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

constexpr const char* kDefaultTable = "default";
constexpr double kShortest_s = 1e-3;

struct Kind {
  const char* name;
  std::vector<std::string_view> keys;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"goal", {"x_m", "y_m", "tolerance_m"}},
                                        {"cancel", {}},
                                        {"correct", {"x_m", "y_m", "heading_deg", "sigma_m", "sigma_deg"}},
                                        {"place", {"x_m", "y_m", "heading_deg"}},
                                        {"reset", {}},
                                        {"param", {"name", "value"}},
                                        {"table", {"name", "file"}},
                                        {"frames_lost", {"for_s"}},
                                        {"restart", {}}};
  return all;
}

std::vector<std::string_view> all_keys() {
  std::vector<std::string_view> keys{"t_s", "kind"};
  for (const Kind& kind : kinds()) {
    for (const std::string_view key : kind.keys) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

/// Of `words`, the one that the key's value names.
std::size_t choice(const TableReader& table, std::string_view key,
                   const std::vector<std::string_view>& words) {
  const std::string word = table.text(key);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::string_view near = nearest_word(word, words);
  table.fail_at(key, words.size() <= kEventKinds
                         ? fmt::format("'{}' must be {}, but is '{}'", key, join_or(words), word)
                         : fmt::format("no parameter has the name '{}'{}", word,
                                       near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

EventKind read_kind(const TableReader& table) {
  std::vector<std::string_view> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  const std::size_t i = choice(table, "kind", names);
  const std::vector<std::string_view>& own = kinds()[i].keys;
  for (const std::string_view key : all_keys()) {
    const bool known = key == "t_s" || key == "kind" || std::find(own.begin(), own.end(), key) != own.end();
    if (!known && table.has(key))
      table.fail_at(key, fmt::format("'{}' does not go with an event of kind \"{}\"", key, names[i]));
  }
  return static_cast<EventKind>(i);
}

std::optional<double> number_if(const TableReader& table, std::string_view key, Limits limits) {
  return table.has(key) ? std::optional(table.number(key, limits)) : std::nullopt;
}

void read_param(const TableReader& table, Event& e) {
  e.param = choice(table, "name", robot_keys());
  const char* const key = param_list({})[e.param].key;
  if (is_fixed_in_a_run(key)) table.fail_at("name", fmt::format("'{}' cannot change during a run", key));
  e.raw = read_param_value(table, "value", e.param);
}

/// The event would set what the robot derives: it is read and has no effect.
bool sets_derived(const TableReader& table) {
  if (!table.has("kind") || table.text("kind") != "param" || !table.has("name")) return false;
  const std::vector<std::string_view> derived = derived_keys();
  const std::string key = table.text("name");
  if (std::find(derived.begin(), derived.end(), key) == derived.end()) return false;
  notice(table.error_at("name", derived_words(key)));
  return true;
}

void read_table(const TableReader& table, Event& e) {
  if (table.has("name") == table.has("file"))
    table.fail(fmt::format("an event of kind \"table\" has either file, or name = \"{}\"", kDefaultTable));
  if (table.has("file")) {
    e.file = table.text("file");
    if (e.file.empty()) table.fail_at("file", "'file' is empty");
  } else if (table.text("name") != kDefaultTable) {
    table.fail_at("name",
                  fmt::format("'name' of a table must be \"{}\"; 'file' names a rule base", kDefaultTable));
  }
}

Event read_event(const TableReader& table) {
  Event e;
  e.kind = read_kind(table);
  e.t_s = table.number("t_s", kEventTime);
  switch (e.kind) {
    case EventKind::goal:
      e.goal.at = {table.number("x_m", kCoordinate), table.number("y_m", kCoordinate)};
      e.goal.tolerance_m = table.number_or("tolerance_m", kLength, e.goal.tolerance_m);
      break;
    case EventKind::correct:
      e.sigma_m = table.number_or("sigma_m", kFixSigma, 0);
      e.sigma_deg = table.number_or("sigma_deg", kFixTurnSigma, 0);
      [[fallthrough]];
    case EventKind::place:
      e.x_m = number_if(table, "x_m", kCoordinate);
      e.y_m = number_if(table, "y_m", kCoordinate);
      e.heading_deg = number_if(table, "heading_deg", {-360, 360});
      break;
    case EventKind::param: read_param(table, e); break;
    case EventKind::table: read_table(table, e); break;
    case EventKind::frames_lost: e.for_s = table.number("for_s", {kShortest_s, kEventTime.high}); break;
    case EventKind::cancel:
    case EventKind::reset:
    case EventKind::restart: break;
  }
  return e;
}

std::string line(const char* key, double x) { return fmt::format("{} = {}\n", key, toml_number(x)); }
std::string line(const char* key, std::optional<double> x) { return x ? line(key, *x) : ""; }

std::string value_text(const Event& e) {
  Params params;
  set_param(params, e.param, e.raw);
  return param_list(params)[e.param].text();
}

std::string keys_of(const Event& e) {
  switch (e.kind) {
    case EventKind::goal:
      return line("x_m", e.goal.at.x) + line("y_m", e.goal.at.y) + line("tolerance_m", e.goal.tolerance_m);
    case EventKind::correct:
    case EventKind::place: {
      const bool fix = e.kind == EventKind::correct;
      return line("x_m", e.x_m) + line("y_m", e.y_m) + line("heading_deg", e.heading_deg) +
             (fix ? line("sigma_m", e.sigma_m) + line("sigma_deg", e.sigma_deg) : "");
    }
    case EventKind::param:
      return fmt::format("name = \"{}\"\nvalue = {}\n", param_list({})[e.param].key, value_text(e));
    case EventKind::table:
      return e.file.empty() ? fmt::format("name = \"{}\"\n", kDefaultTable)
                            : fmt::format("file = {}\n", toml_string(e.file));
    case EventKind::frames_lost: return line("for_s", e.for_s);
    case EventKind::cancel:
    case EventKind::reset:
    case EventKind::restart: break;
  }
  return "";
}

}  // namespace

const char* name(EventKind kind) { return kinds()[static_cast<std::size_t>(kind)].name; }

bool is_fixed_in_a_run(const char* key) {
  const std::string_view fixed[] = {"control_period_s", "bumper", "gyro"};
  return std::find(std::begin(fixed), std::end(fixed), key) != std::end(fixed);
}

std::vector<Event> read_events(const TableReader& top) {
  std::vector<Event> events;
  for (const TableReader& table : top.tables("event", all_keys())) {
    if (!sets_derived(table)) events.push_back(read_event(table));
  }
  return events;
}

std::string events_toml(const std::vector<Event>& events) {
  std::string out;
  for (const Event& e : events) {
    out +=
        fmt::format("\n[[event]]\nt_s = {}\nkind = \"{}\"\n", toml_number(e.t_s), name(e.kind)) + keys_of(e);
  }
  return out;
}

}  // namespace whisker
