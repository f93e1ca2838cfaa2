#include "host/harness/scenario/violations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
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
/// longer than a 48th of that distance, or contains the end.
std::optional<Fitting> towards(std::int64_t now, std::int64_t end,
                               const std::function<bool(std::int64_t)>& fits) {
  constexpr std::int64_t kSamples = 48;
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

bool is_one_of(std::string_view key, std::initializer_list<std::string_view> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// A number, and not the zero of a beam that has no value of its own.
bool is_of_use(const ParamEntry& e) { return e.word == nullptr && !(e.of_one_beam() && e.raw == 0); }

/// Whether an owner can change the parameter without other hardware, down or up.
bool is_free(const ParamEntry& e, bool down) {
  const std::string_view key = e.key;
  if (!is_of_use(e)) return false;
  if (is_one_of(key,
                {"wheel_speed_max_mps", "wheel_acceleration_max_mps2", "turn_rate_max_radps", "range_max_m"}))
    return down;
  return is_one_of(key, {"body_margin_m", "stale_after_s", "wheels_stalled_after_s", "range_clear_m",
                         "length_budget_m", "creep_speed_mps"});
}

/// Whether the relation holds with these parameters; with `strictly`, only if no other one is broken anew.
bool mended(const Params& params, ParamFault fault, const Broken& now, bool strictly) {
  const Broken then = broken(params);
  if (then[static_cast<std::size_t>(fault)]) return false;
  for (std::size_t i = 0; strictly && i < then.size(); ++i) {
    if (then[i] && !now[i]) return false;
  }
  return true;
}

enum class Only { free, all };

/// Calls use(place, fitting) for every change of one parameter that satisfies the relation.
template <class F>
void for_each_mend(const Params& params, const Violation& v, const Broken& now, bool strictly, Only only,
                   const F& use) {
  const std::vector<ParamEntry> list = param_list(params);
  for (const std::size_t place : v.keys) {
    const ParamEntry& e = list[place];
    if (!is_of_use(e)) continue;
    const auto fits = [&](std::int64_t raw) {
      Params changed = params;
      set_param(changed, place, raw);
      return mended(changed, v.fault, now, strictly);
    };
    for (const bool down : {true, false}) {
      if (only == Only::free && !is_free(e, down)) continue;
      if (const auto found = towards(e.raw, down ? e.low : e.high, fits)) use(place, *found);
    }
  }
}

/// How much a change changes: the logarithm of the ratio; 1 from or to zero, which stands for "automatic".
double weight(std::int64_t from, std::int64_t to) {
  if (from == to) return 0;
  if (from <= 0 || to <= 0) return 1;
  return std::fabs(std::log(static_cast<double>(to) / static_cast<double>(from)));
}

/// Changes with their weight.
struct Plan {
  std::vector<Change> changes;
  double weight = std::numeric_limits<double>::infinity();
  void keep(Plan other) {
    if (other.weight < weight) *this = std::move(other);
  }
};

/// The lightest change of one free parameter that satisfies the relation.
Plan single(const Params& params, const Violation& v, const Broken& now, bool strictly) {
  const std::vector<ParamEntry> list = param_list(params);
  Plan best;
  for_each_mend(params, v, now, strictly, Only::free, [&](std::size_t place, const Fitting& f) {
    best.keep({{{place, f.nearest}}, weight(list[place].raw, f.nearest)});
  });
  return best;
}

/// The same of two: one takes some values of its range, the other follows.
Plan pair(const Params& params, const Violation& v, const Broken& now, bool strictly) {
  constexpr int kValues = 8;
  const std::vector<ParamEntry> list = param_list(params);
  Plan best;
  for (const std::size_t place : v.keys) {
    const ParamEntry& e = list[place];
    for (const bool down : {true, false}) {
      if (!is_free(e, down)) continue;
      const std::int64_t end = down ? e.low : e.high;
      for (int i = 1; i <= kValues; ++i) {
        const double share = std::pow(static_cast<double>(i) / kValues, 2);
        const std::int64_t raw = e.raw + std::llround(static_cast<double>(end - e.raw) * share);
        Params changed = params;
        set_param(changed, place, raw);
        Plan plan = single(changed, v, now, strictly);
        if (plan.changes.empty() || plan.changes.front().key == place) continue;
        plan.weight += weight(e.raw, raw);
        plan.changes.push_back({place, raw});
        best.keep(std::move(plan));
      }
    }
  }
  return best;
}

/// What satisfies the relation. free: changes without other hardware end all violations.
void find_mends(const Params& params, Violation& v, const Broken& now, bool free) {
  const std::vector<ParamEntry> list = param_list(params);
  for (const Only only : {Only::free, Only::all}) {
    v.of_hardware = only == Only::all;
    for (const bool strictly : {true, false}) {
      if (!strictly && !free && only == Only::free) continue;
      for_each_mend(params, v, now, strictly, only, [&](std::size_t place, const Fitting& f) {
        const ParamEntry& e = list[place];
        v.fits.push_back(words(e, f));
        v.ray = v.ray || (std::string_view(e.key).find("_cone_deg") != std::string_view::npos &&
                          e.raw < Angle{5_deg}.raw());
      });
      const Plan two = only == Only::free && v.fits.empty() ? pair(params, v, now, strictly) : Plan{};
      if (!two.changes.empty()) v.fits = {words(params, two.changes)};
      if (!v.fits.empty()) return;
    }
  }
}

/// The relations that are broken, with their keys.
std::vector<Violation> found(const Params& params) {
  const std::vector<ParamEntry> list = param_list(params);
  std::vector<Violation> all;
  for_each_relation(params, [&](ParamFault fault, bool holds) {
    if (holds) return true;
    all.push_back({fault, keys_in(relation(fault).words, list), {}});
    add_own_keys(all.back().keys, list);
    return true;
  });
  return all;
}

/// Each change as small as the others allow, and then as short as it can be written.
std::vector<Change> least(const Params& params, const Params& fit) {
  const std::vector<ParamEntry> before = param_list(params);
  Params now = fit;
  const auto fits = [&now](std::size_t key, std::int64_t raw) {
    Params changed = now;
    set_param(changed, key, raw);
    return check(changed) == ParamFault::none;
  };
  std::vector<Change> changes;
  for (std::size_t key = 0; key < before.size(); ++key) {
    const std::int64_t from = before[key].raw, to = param_list(now)[key].raw;
    if (from == to) continue;
    const std::int64_t nearest =
        fits(key, from) ? from : edge(to, from, [&](std::int64_t raw) { return fits(key, raw); });
    set_param(now, key, nearest);
    if (nearest != from) changes.push_back({key, nearest});
  }
  for (Change& c : changes) {
    const ParamEntry& e = before[c.key];
    const double exact = static_cast<double>(c.raw) * e.unit.denominator / e.unit.numerator;
    for (double scale = 1; scale <= 1e6; scale *= 10) {
      const double whole = c.raw > e.raw ? std::ceil(exact * scale) : std::floor(exact * scale);
      const std::int64_t raw = to_raw(whole / scale, e.unit);
      const bool near = std::fabs(whole / scale - exact) <= 0.1 * std::fabs(exact);
      if (!near || raw < e.low || raw > e.high || !fits(c.key, raw)) continue;
      set_param(now, c.key, c.raw = raw);
      break;
    }
  }
  return changes;
}

std::vector<Change> tuned(const Params& params) {
  constexpr int kMostSteps = 24;
  Params now = params;
  for (int step = 0; step < kMostSteps; ++step) {
    const std::vector<Violation> all = found(now);
    if (all.empty()) return least(params, now);
    const Broken broken_now = broken(now);
    Plan best;
    for (const bool strictly : {true, false}) {
      for (const auto& change : {single, pair}) {
        for (const Violation& v : all) {
          if (best.changes.empty()) best = change(now, v, broken_now, strictly);
        }
      }
    }
    if (best.changes.empty()) return {};
    for (const Change& c : best.changes) set_param(now, c.key, c.raw);
  }
  return {};
}

}  // namespace

Violations violations(const Params& params) {
  Violations v{found(params), tuned(params)};
  const Broken now = broken(params);
  for (Violation& one : v.all) find_mends(params, one, now, !v.together.empty());
  return v;
}

std::string words(const Params& params, const std::vector<Change>& changes) {
  const std::vector<ParamEntry> list = param_list(params);
  std::string all;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const ParamEntry& e = list[changes[i].key];
    all += fmt::format("{}{} = {}",
                       i == 0                   ? ""
                       : i + 1 < changes.size() ? ", "
                                                : " and ",
                       e.key, e.text_of(changes[i].raw));
  }
  return all;
}

}  // namespace whisker
