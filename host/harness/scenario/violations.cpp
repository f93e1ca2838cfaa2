#include "host/harness/scenario/violations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/params_text.hpp"

namespace whisker {
namespace {

using Broken = std::array<bool, kParamFaults>;

Broken broken(const Params& params) {
  Broken found{};
  for_each_relation(params, [&found](ParamFault fault, bool holds) {
    found[static_cast<std::size_t>(fault)] = !holds;
    return true;
  });
  return found;
}

bool is_of_a_key(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The keys that the relation's sentence names.
std::vector<std::size_t> keys_in(std::string_view sentence, const std::vector<ParamEntry>& list) {
  std::vector<std::size_t> keys;
  for (std::size_t i = 0; i < sentence.size();) {
    std::size_t end = i;
    while (end < sentence.size() && is_of_a_key(sentence[end])) ++end;
    const std::string_view word = sentence.substr(i, end - i);
    const auto named = std::find_if(list.begin(), list.end(), [&](const auto& e) { return e.key == word; });
    const auto place = static_cast<std::size_t>(named - list.begin());
    if (named != list.end() && std::find(keys.begin(), keys.end(), place) == keys.end())
      keys.push_back(place);
    i = std::max(end, i + 1);
  }
  return keys;
}

/// The key that a beam's own key replaces: range_left_cone_deg, range_cone_deg.
std::string shared_key(std::string_view own) {
  const std::string_view what = own.substr(own.find('_', own.find('_') + 1) + 1);
  if (what == "x_m" || what == "y_m") return "range_offset_m";
  if (what == "angle_deg") return "range_side_angle_deg";
  return fmt::format("range_{}", what);
}

/// Where the sentence names a key that all beams share, beams that have a value of their own count too.
void add_own_keys(std::vector<std::size_t>& keys, const std::vector<ParamEntry>& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].of_one_beam() || list[i].raw == 0 || std::count(keys.begin(), keys.end(), i) != 0) continue;
    const auto is_shared = [&](std::size_t k) { return list[k].key == shared_key(list[i].key); };
    if (std::any_of(keys.begin(), keys.end(), is_shared)) keys.push_back(i);
  }
}

/// The values of one parameter that satisfy the relation, on one side of its current value.
struct Fitting {
  std::int64_t nearest;
  std::int64_t farthest;
};

/// Bisects between `inside`, which fits, and `outside`, which does not; returns the last value that fits.
std::int64_t edge(std::int64_t inside, std::int64_t outside, const std::function<bool(std::int64_t)>& fits) {
  while (std::abs(inside - outside) > 1) {
    const std::int64_t middle = inside + (outside - inside) / 2;
    (fits(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// The first interval that fits between `now`, which does not fit, and the range's end. It is found if it is
/// longer than a 64th of that distance, or contains the end.
std::optional<Fitting> towards(std::int64_t now, std::int64_t end,
                               const std::function<bool(std::int64_t)>& fits) {
  constexpr std::int64_t kSamples = 64;
  std::int64_t before = now;
  std::optional<Fitting> found;
  for (std::int64_t i = 1; i <= kSamples; ++i) {
    const std::int64_t sample = now + (end - now) * i / kSamples;
    if (sample == before) continue;
    const bool good = fits(sample);
    if (good && !found) found = Fitting{edge(sample, before, fits), sample};
    if (found && !good) return Fitting{found->nearest, edge(found->farthest, sample, fits)};
    if (found) found->farthest = sample;
    before = sample;
  }
  return found;
}

/// A value as short as possible between `bound` and `inside`, at most a thousandth of `bound` away from it.
std::string short_of(const ParamEntry& e, std::int64_t bound, std::int64_t inside) {
  constexpr int kMostDigits = 6;
  constexpr double kThousandth = 0.001;
  const double exact = static_cast<double>(bound) * e.unit.denominator / e.unit.numerator;
  double scale = 1;
  for (int digits = 0; digits < kMostDigits; ++digits, scale *= 10) {
    for (const double whole : {std::floor(exact * scale), std::ceil(exact * scale)}) {
      const std::int64_t raw = to_raw(whole / scale, e.unit);
      const bool between = std::min(bound, inside) <= raw && raw <= std::max(bound, inside);
      if (between && std::abs(whole / scale - exact) <= std::abs(exact) * kThousandth) return e.text_of(raw);
    }
  }
  return e.text_of(bound);
}

std::string words(const ParamEntry& e, const Fitting& f) {
  const std::string nearest = short_of(e, f.nearest, f.farthest);
  if (f.nearest == f.farthest) return fmt::format("{} = {}", e.key, nearest);
  if (f.farthest == e.high) return fmt::format("{} >= {}", e.key, nearest);
  if (f.farthest == e.low) return fmt::format("{} <= {}", e.key, nearest);
  const std::string farthest = short_of(e, f.farthest, f.nearest);
  return f.nearest < f.farthest ? fmt::format("{} from {} to {}", e.key, nearest, farthest)
                                : fmt::format("{} from {} to {}", e.key, farthest, nearest);
}

/// The changes that satisfy the relation; with `strictly`, only those that break no other relation.
std::vector<std::string> mends(const Params& params, const Violation& v, const Broken& now, bool strictly) {
  const std::vector<ParamEntry> list = param_list(params);
  std::vector<std::string> all;
  for (const std::size_t place : v.keys) {
    if (list[place].word != nullptr || (list[place].of_one_beam() && list[place].raw == 0)) continue;
    const auto fits = [&](std::int64_t raw) {
      Params changed = params;
      set_param(changed, place, raw);
      const Broken then = broken(changed);
      if (then[static_cast<std::size_t>(v.fault)]) return false;
      for (std::size_t i = 0; strictly && i < then.size(); ++i) {
        if (then[i] && !now[i]) return false;
      }
      return true;
    };
    for (const std::int64_t end : {list[place].low, list[place].high}) {
      if (const auto found = towards(list[place].raw, end, fits)) all.push_back(words(list[place], *found));
    }
  }
  return all;
}

}  // namespace

std::vector<Violation> violations(const Params& params) {
  const Broken now = broken(params);
  const std::vector<ParamEntry> list = param_list(params);
  std::vector<Violation> all;
  for_each_relation(params, [&](ParamFault fault, bool holds) {
    if (holds) return true;
    all.push_back({fault, keys_in(relation(fault).words, list), {}});
    add_own_keys(all.back().keys, list);
    return true;
  });
  for (Violation& v : all) {
    v.fits = mends(params, v, now, true);
    if (v.fits.empty()) v.fits = mends(params, v, now, false);
  }
  return all;
}

}  // namespace whisker
