#include "host/scenario/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "host/scenario/params_text.hpp"
#include "host/scenario/text.hpp"

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

  template <class T>
  void number(const char* key, T& x, T low, T high) {
    if (!table.has(key)) return;
    const ParamUnit unit = unit_of(x);
    // The range is checked after rounding, so that a limit that is no whole raw unit
    // (170 degrees) is inside its own range.
    const double si = table.number(key, {-kAnyNumber, kAnyNumber});
    const std::int64_t raw = to_raw(std::clamp(si, -kMostSi, kMostSi), unit);
    if (raw < std::int64_t{low.raw()} || raw > std::int64_t{high.raw()}) {
      table.fail_at(key, fmt::format("'{}' must be from {} to {} {}, but is {}", key,
                                     si_text(low.raw(), unit), si_text(high.raw(), unit), unit.symbol, si));
    }
    x = from_raw(x, raw);
  }

  void count(const char* key, std::int32_t& x, std::int32_t low, std::int32_t high) {
    if (table.has(key)) x = static_cast<std::int32_t>(table.integer(key, low, high));
  }

  template <class E>
  void choice(const char* key, E& x, const char* const* names, int count) {
    if (!table.has(key)) return;
    const std::string word = table.text(key);
    for (int i = 0; i < count; ++i) {
      if (word == names[i]) {
        x = static_cast<E>(i);
        return;
      }
    }
    const std::vector<std::string_view> words(names, names + count);
    table.fail_at(key, fmt::format("'{}' must be {}, but is '{}'", key, join_or(words), word));
  }
};

}  // namespace

void read_robot(const TableReader& table, Params& params) {
  Setter setter{table};
  for_each_param(params, setter);
}

void check_robot(const TableReader& table, const Params& params) {
  const ParamFault fault = check(params);
  if (fault != ParamFault::none) table.fail(relation(fault));
}

}  // namespace whisker
