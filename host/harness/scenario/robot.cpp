#include "host/harness/scenario/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"
#include "host/harness/scenario/text.hpp"
#include "host/harness/scenario/violations.hpp"

namespace whisker {
namespace {

constexpr double kAnyNumber = std::numeric_limits<double>::max();
constexpr double kMostSi = 1e9;  // beyond every range, and safe for to_raw()

Angle from_raw(Angle, std::int64_t raw) { return Angle::from_raw(static_cast<std::uint32_t>(raw)); }
template <class Tag>
Unit<Tag> from_raw(Unit<Tag>, std::int64_t raw) {
  return Unit<Tag>::from_raw(static_cast<std::int32_t>(raw));
}

struct Setter {
  const TableReader& table;
  std::vector<InputError>& errors;

  template <class T>
  void number(const char* key, T& x, T low, T high) {
    if (!table.has(key)) return;
    const ParamUnit unit = unit_of(x);
    // The range is checked after rounding, so that a limit without an exact raw value (170 degrees) is inside
    // its own range.
    tried([&] {
      const double si = table.number(key, {-kAnyNumber, kAnyNumber});
      const std::int64_t raw = to_raw(std::clamp(si, -kMostSi, kMostSi), unit);
      if (raw < std::int64_t{low.raw()} || raw > std::int64_t{high.raw()}) {
        table.fail_at(key, fmt::format("'{}' must be from {} to {} {}, but is {}", key,
                                       si_text(low.raw(), unit), si_text(high.raw(), unit), unit.symbol, si));
      }
      x = from_raw(x, raw);
    });
  }

  void count(const char* key, std::int32_t& x, std::int32_t low, std::int32_t high) {
    if (table.has(key)) tried([&] { x = static_cast<std::int32_t>(table.integer(key, low, high)); });
  }

  template <class E>
  void choice(const char* key, E& x, const char* const* names, int count) {
    if (!table.has(key)) return;
    tried([&] {
      if (is_boolean(names, count)) {
        x = static_cast<E>(table.boolean(key) ? 1 : 0);
        return;
      }
      const std::string word = table.text(key);
      const auto* const named = std::find(names, names + count, word);
      if (named == names + count) {
        const std::vector<std::string_view> words(names, names + count);
        table.fail_at(key, fmt::format("'{}' must be {}, but is '{}'", key, join_or(words), word));
      }
      x = static_cast<E>(named - names);
    });
  }

  void derived(const char* key) {
    if (table.has(key)) notice(table.error_at(key, derived_words(key)));
  }

  template <class F>
  void tried(const F& set) {
    try {
      set();
    } catch (const InputError& e) {
      errors.push_back(e);
    }
  }
};

/// Sets one parameter from a key with another name.
struct OneSetter {
  Setter setter;
  std::string_view param;
  const char* key;

  template <class T>
  void number(const char* name, T& x, T low, T high) {
    if (name == param) setter.number(key, x, low, high);
  }
  void count(const char* name, std::int32_t& x, std::int32_t low, std::int32_t high) {
    if (name == param) setter.count(key, x, low, high);
  }
  template <class E>
  void choice(const char* name, E& x, const char* const* names, int count) {
    if (name == param) setter.choice(key, x, names, count);
  }
  void derived(const char*) {}
};

const TableReader* table_with(const RobotTables& tables, const char* key) {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.has(key); });
  return found == tables.end() ? nullptr : &*found;
}

InputError error_of(const RobotTables& tables, const std::vector<ParamEntry>& list, const Violation& v) {
  std::string values, mends;
  const TableReader* where = nullptr;
  const char* at = nullptr;
  for (const std::size_t place : v.keys) {
    const ParamEntry& e = list[place];
    const TableReader* const table = table_with(tables, e.key);
    // Zero stands for the value that all beams share.
    if (table == nullptr && e.raw == 0 && e.of_one_beam()) continue;
    if (where == nullptr && table != nullptr) where = table, at = e.key;
    values +=
        fmt::format("{}{} = {} ({})", values.empty() ? "" : ", ", e.key, e.text(),
                    table == nullptr ? "not in this file" : fmt::format("line {}", table->line_of(e.key)));
  }
  for (const std::string& fit : v.fits) mends += (mends.empty() ? "" : " or ") + fit;
  if (v.ray) mends += "; of a scan, let each beam be the nearest reading of a sector 40 degrees wide";
  const std::string what =
      fmt::format("{}: {}{}", values, relation(v.fault).words,
                  mends.empty()   ? ""
                  : v.of_hardware ? "; the robot itself would have to differ: it would fit with " + mends
                                  : "; it would fit with " + mends);
  return where == nullptr ? tables.front().error(what) : where->error_at(at, what);
}

}  // namespace

void read_robot(const RobotTables& tables, Params& params) {
  std::vector<InputError> errors;
  for (const TableReader& table : tables) {
    Setter setter{table, errors};
    for_each_param(params, setter);
  }
  if (!errors.empty()) throw InputErrors(std::move(errors));
}

std::int64_t read_param_value(const TableReader& table, const char* key, std::size_t param) {
  if (!table.has(key)) table.fail(fmt::format("'{}' is missing", key));
  Params params;
  std::vector<InputError> errors;
  OneSetter setter{{table, errors}, param_list(params)[param].key, key};
  for_each_param(params, setter);
  if (!errors.empty()) throw InputErrors(std::move(errors));
  return param_list(params)[param].raw;
}

void check_robot(const RobotTables& tables, const Params& params) {
  const std::vector<ParamEntry> list = param_list(params);
  std::vector<InputError> errors;
  const Violations found = violations(params);
  for (const Violation& v : found.all) errors.push_back(error_of(tables, list, v));
  if (errors.empty()) return;
  std::string advice =
      errors.size() > 1 && !found.together.empty()
          ? tables.front().error("all of this fits with " + words(params, found.together)).what()
          : std::string();
  InputErrors::Changes changes;
  for (const Change& c : found.together) changes.emplace_back(list[c.key].key, list[c.key].text_of(c.raw));
  throw InputErrors(std::move(errors), std::move(advice), std::move(changes));
}

}  // namespace whisker
