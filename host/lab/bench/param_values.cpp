#include "host/lab/bench/param_values.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

#include "host/harness/scenario/text.hpp"

namespace whisker::bench {
namespace {

constexpr double kMostSi = 1e9;  // beyond every range, and safe for to_raw()

const std::vector<ParamEntry>& reference() {
  static const std::vector<ParamEntry> list = param_list(Params{});
  return list;
}

std::string with_unit(const std::string& number, const ParamEntry& e) {
  return *e.unit.symbol == 0 ? number : fmt::format("{} {}", number, e.unit.symbol);
}

std::int64_t choice_of(std::size_t place, std::string_view text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  const std::vector<std::string> words = words_of(place);
  const auto named = std::find(words.begin(), words.end(), text);
  if (named != words.end()) return named - words.begin();
  throw std::invalid_argument(fmt::format("{} = {}: must be {}", reference()[place].key, text,
                                          range_text(reference()[place], place)));
}

}  // namespace

std::vector<std::string> words_of(std::size_t place) {
  const ParamEntry& entry = reference()[place];
  std::vector<std::string> words;
  for (std::int64_t raw = entry.low; entry.word != nullptr && raw <= entry.high; ++raw) {
    Params params;
    set_param(params, place, raw);
    words.emplace_back(param_list(params)[place].word);
  }
  return words;
}

std::string value_text(const ParamEntry& entry, std::int64_t raw) {
  if (entry.word == nullptr) return with_unit(entry.text_of(raw), entry);
  return words_of(place_of(entry.key)).at(static_cast<std::size_t>(raw));
}

std::string range_text(const ParamEntry& entry, std::size_t place) {
  if (entry.word == nullptr) {
    return with_unit(fmt::format("{} to {}", entry.text_of(entry.low), entry.text_of(entry.high)), entry);
  }
  const std::vector<std::string> words = words_of(place);
  return join_or({words.begin(), words.end()});
}

std::size_t place_of(std::string_view name) {
  const auto& list = reference();
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& e) { return e.key == name; });
  if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
  const std::string_view near = nearest_word(name, robot_keys());
  throw std::invalid_argument(fmt::format("no parameter '{}'{}", name,
                                          near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

std::string outside_text(std::size_t place, std::string_view value, std::int64_t raw) {
  const ParamEntry& e = reference()[place];
  const std::string_view why = raw < e.low ? "too small" : raw > e.high ? "too large" : "refused";
  return fmt::format("{} = {}: {}; it may be {}; the nearest allowed value is {}", e.key, value, why,
                     range_text(e, place), value_text(e, std::clamp(raw, e.low, e.high)));
}

Assignment parse_assignment(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    throw std::invalid_argument(fmt::format("'{}' is no NAME=VALUE", text));
  }
  const std::size_t place = place_of(trimmed(text.substr(0, equals)));
  const std::string_view value = trimmed(text.substr(equals + 1));
  const ParamEntry& e = reference()[place];
  if (e.word != nullptr) return {place, choice_of(place, value)};
  double si = 0;
  const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), si);
  const bool number = error == std::errc{} && rest == value.data() + value.size() && si == si;
  if (!number) {
    throw std::invalid_argument(
        fmt::format("{} = '{}': is no number; it may be {}", e.key, value, range_text(e, place)));
  }
  const std::int64_t raw = to_raw(std::clamp(si, -kMostSi, kMostSi), e.unit);
  if (raw < e.low || raw > e.high) throw std::invalid_argument(outside_text(place, value, raw));
  const bool whole = std::string_view(e.type) != "int32_t" || si == static_cast<double>(raw);
  if (!whole) throw std::invalid_argument(fmt::format("{} = {}: must be a whole number", e.key, value));
  return {place, raw};
}

std::string saved_toml(const Params& params, std::string_view origin) {
  std::string out = fmt::format("# {}\n", origin);
  const std::vector<ParamEntry> list = param_list(params);
  std::size_t widest = 0;
  for (const ParamEntry& e : list) widest = std::max(widest, fmt::formatted_size("{} = {}", e.key, e.text()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string line = fmt::format("{} = {}", list[i].key, list[i].text());
    out += fmt::format("{:<{}}  # {}\n", line, widest, range_text(list[i], i));
  }
  return out;
}

}  // namespace whisker::bench
