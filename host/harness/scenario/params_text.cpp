#include "host/harness/scenario/params_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace whisker {
namespace {

struct Keys {
  std::vector<std::string_view> all;
  template <class T>
  void number(const char* key, const T&, T, T) {
    all.emplace_back(key);
  }
  void count(const char* key, const std::int32_t&, std::int32_t, std::int32_t) { all.emplace_back(key); }
  template <class E>
  void choice(const char* key, const E&, const char* const*, int) {
    all.emplace_back(key);
  }
  void derived(const char*) {}
};

struct DerivedKeys {
  std::vector<std::string_view> all;
  template <class T>
  void number(const char*, const T&, T, T) {}
  void count(const char*, const std::int32_t&, std::int32_t, std::int32_t) {}
  template <class E>
  void choice(const char*, const E&, const char* const*, int) {}
  void derived(const char* key) { all.emplace_back(key); }
};

struct Row {
  std::string key, unit, value, range;
};

struct Rows {
  std::vector<Row> all;
  template <class T>
  void number(const char* key, const T& x, T low, T high) {
    const ParamUnit unit = unit_of(x);
    all.push_back({key, unit.symbol, si_text(x.raw(), unit),
                   si_text(low.raw(), unit) + " to " + si_text(high.raw(), unit)});
  }
  void count(const char* key, const std::int32_t& x, std::int32_t low, std::int32_t high) {
    all.push_back({key, "integer", fmt::format("{}", x), fmt::format("{} to {}", low, high)});
  }
  template <class E>
  void choice(const char* key, const E& x, const char* const* names, int count) {
    const bool boolean = is_boolean(names, count);
    std::string words;
    for (int i = 0; i < count; ++i) words += (i == 0 ? "" : ", ") + choice_text(names[i], boolean);
    const char* const chosen = names[static_cast<int>(x)];
    all.push_back({key, boolean ? "boolean" : "one of", choice_text(chosen, boolean), words});
  }
  void derived(const char*) {}
};

std::vector<Row> rows(const Params& params) {
  Rows rows;
  for_each_param(params, rows);
  return rows.all;
}

}  // namespace

bool is_boolean(const char* const* names, int count) {
  return count == 2 && std::string_view(names[0]) == "false" && std::string_view(names[1]) == "true";
}

std::string choice_text(const char* word, bool boolean) {
  return boolean ? word : fmt::format("\"{}\"", word);
}

std::int64_t to_raw(double si, ParamUnit unit) {
  return std::llround(si * unit.numerator / unit.denominator);
}

std::string si_text(std::int64_t raw, ParamUnit unit) {
  const double si = static_cast<double>(raw) * unit.denominator / unit.numerator;
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", si, digits);
    if (to_raw(std::strtod(text.c_str(), nullptr), unit) == raw) break;
  }
  // %g turns 20 into 2e+01; the shortest form of that number does not.
  return fmt::format("{}", std::strtod(text.c_str(), nullptr));
}

std::vector<std::string_view> robot_keys() {
  Keys keys;
  const Params reference;
  for_each_param(reference, keys);
  return keys.all;
}

std::vector<std::string_view> derived_keys() {
  DerivedKeys keys;
  const Params reference;
  for_each_param(reference, keys);
  return keys.all;
}

std::vector<std::string_view> keys_in_files() {
  std::vector<std::string_view> keys = robot_keys(), derived = derived_keys();
  keys.insert(keys.end(), derived.begin(), derived.end());
  return keys;
}

std::string robot_toml(const Params& params) {
  const std::vector<Row> reference = rows(Params{});
  const std::vector<Row> chosen = rows(params);
  std::string out;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i].value == reference[i].value) continue;
    out += fmt::format("{} = {}\n", chosen[i].key, chosen[i].value);
  }
  return out;
}

bool must_set(std::string_view key) {
  return std::find(std::begin(kMustSet), std::end(kMustSet), key) != std::end(kMustSet);
}

std::string derived_words(std::string_view key) { return fmt::format("'{}' is derived: ignored", key); }

std::string params_markdown() {
  std::string out;
  for (const bool must : {true, false}) {
    out += must ? "Of the robot, to be set (the default is the reference robot's):\n\n"
                : "\nThat may be tuned:\n\n";
    out += "| Key | Unit | Default | Range |\n|---|---|---|---|\n";
    for (const Row& row : rows(Params{})) {
      if (must_set(row.key) != must) continue;
      out += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.unit, row.value, row.range);
    }
  }
  out += "\nDerived (`firmware/params/derived.hpp`): a file may have these keys, and they are ignored:";
  for (const std::string_view key : derived_keys()) out += fmt::format("\n`{}`", key);
  return out + "\n";
}

}  // namespace whisker
