// Random scenarios survive writing and reading. RC_PARAMS="seed=... reproduce=..." repeats a failure.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/check.hpp"
#include "host/harness/scenario/contact.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/noise.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/harness/scenario/sensor_models.hpp"
#include "host/harness/scenario/write.hpp"

namespace whisker {
namespace {

using sim::Vec2;

std::uint64_t bits() { return *rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>()); }
int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
/// Every second number is one that a person would write.
double number(double low, double high) {
  const double x = low + (high - low) * (static_cast<double>(bits() >> 11) / 9007199254740992.0);
  return below(2) == 0 ? x : std::clamp(std::round(x * 100) / 100, low, high);
}
Vec2 point(double extent) {
  const double x = number(-extent, extent);
  return {x, number(-extent, extent)};
}

std::string any_name() {
  const char* const pieces[] = {
      "a", "Z9", " ", "\"", "\\", "#", "=", "'", "\xC3\xA9", "\xE2\x86\x92", "\xF0\x9F\xA4\x96"};
  std::string name;
  for (int i = below(12); i > 0; --i) name += pieces[below(11)];
  return name;
}

/// Points at increasing angles around a centre: a simple polygon.
std::vector<Vec2> star(Vec2 center) {
  std::vector<Vec2> points;
  const int n = 3 + below(6);
  for (int i = 0; i < n; ++i) {
    const double angle = (i + number(0, 0.8)) * 6.283185307179586 / n;
    points.push_back(center + Vec2{std::cos(angle), std::sin(angle)} * number(0.5, 3));
  }
  return points;
}

/// Changes each parameter and restores it if check() rejects it.
struct Shuffle {
  const Params& whole;
  template <class T>
  void number(const char*, T& x, T low, T high) {
    const T old = x;
    const auto span = static_cast<std::uint64_t>(std::int64_t{high.raw()} - std::int64_t{low.raw()});
    x = T::from_raw(static_cast<decltype(low.raw())>(std::int64_t{low.raw()} +
                                                     static_cast<std::int64_t>(bits() % (span + 1))));
    if (check(whole) != ParamFault::none) x = old;
  }
  void count(const char*, std::int32_t& x, std::int32_t low, std::int32_t high) {
    const std::int32_t old = x;
    x = low + below(high - low + 1);
    if (check(whole) != ParamFault::none) x = old;
  }
  template <class E>
  void choice(const char*, E& x, const char* const*, int count) {
    const E old = x;
    x = static_cast<E>(below(count));
    if (check(whole) != ParamFault::none) x = old;
  }
  void derived(const char*) {}
};

struct Values {
  std::vector<std::int64_t> all;
  template <class T>
  void number(const char*, const T& x, T, T) {
    all.push_back(x.raw());
  }
  void count(const char*, const std::int32_t& x, std::int32_t, std::int32_t) { all.push_back(x); }
  template <class E>
  void choice(const char*, const E& x, const char* const*, int) {
    all.push_back(static_cast<std::int64_t>(x));
  }
  void derived(const char*) {}
};

std::vector<std::int64_t> values(const Params& params) {
  Values v;
  for_each_param(params, v);
  return v.all;
}

/// Adds the result of `add` unless it touches the start.
template <class F>
void try_add(Scenario& s, F&& add) {
  Scenario more = s;
  add(more);
  if (start_fault(more).empty()) s = more;
}

Sensor any_sensor() {
  Sensor s;
  if (below(2) == 0) {
    const std::vector<std::string_view> names = sensor_model_names();
    apply(*find_sensor_model(names[bits() % names.size()]), s);
  }
  const auto set = [](auto& x, double low, double high) {
    if (below(2) == 0) x = number(low, high);
  };
  set(s.incidence_deg, 5, 90);
  set(s.cone_deg, 20, 170);
  set(s.cone_far_deg, 1, 20);
  if (s.cone_deg && s.cone_far_deg) s.cone_far_deg = std::min(*s.cone_far_deg, *s.cone_deg);
  set(s.corner_scatter_m, 0, 2);
  set(s.min_range_m, 0, 0.2);
  set(s.max_range_m, 0.4, 20);
  set(s.sigma_m, 0, 1);
  set(s.sigma_share, 0, 1);
  set(s.soft_range_m, 0, 3);
  set(s.reflectance_reference, 0, 1);
  set(s.ambient_knee_klux, 0, 9);
  set(s.skew_deg, -45, 45);
  set(s.scale, 0.5, 2);
  set(s.phantom, 0, 1);
  set(s.crosstalk, 0, 1);
  set(s.cover_glass_probability, 0, 1);
  set(s.cover_glass_m, 0, 1);
  set(s.soft, 0, 1);
  set(s.reflectance, 0, 1);
  set(s.ambient_klux, 0, 100);
  if (below(2) == 0) s.lost_is = below(2) == 0 ? Lost::clear : Lost::invalid;
  if (below(2) == 0) s.near_is = below(2) == 0 ? Near::too_near : Near::farther;
  s.far_is = below(2) == 0 ? Far::clear : Far::distance;
  return s;
}

void same(const Sensor& a, const Sensor& b) {
  RC_ASSERT(a.model == b.model);
  RC_ASSERT(a.incidence_deg == b.incidence_deg);
  RC_ASSERT(a.cone_deg == b.cone_deg);
  RC_ASSERT(a.cone_far_deg == b.cone_far_deg);
  RC_ASSERT(a.corner_scatter_m == b.corner_scatter_m);
  RC_ASSERT(a.min_range_m == b.min_range_m);
  RC_ASSERT(a.max_range_m == b.max_range_m);
  RC_ASSERT(a.sigma_m == b.sigma_m);
  RC_ASSERT(a.sigma_share == b.sigma_share);
  RC_ASSERT(a.soft_range_m == b.soft_range_m);
  RC_ASSERT(a.reflectance_reference == b.reflectance_reference);
  RC_ASSERT(a.ambient_knee_klux == b.ambient_knee_klux);
  RC_ASSERT(a.lost_is == b.lost_is);
  RC_ASSERT(a.near_is == b.near_is);
  RC_ASSERT(a.far_is == b.far_is);
  RC_ASSERT(a.skew_deg == b.skew_deg);
  RC_ASSERT(a.scale == b.scale);
  RC_ASSERT(a.phantom == b.phantom);
  RC_ASSERT(a.crosstalk == b.crosstalk);
  RC_ASSERT(a.cover_glass_probability == b.cover_glass_probability);
  RC_ASSERT(a.cover_glass_m == b.cover_glass_m);
  RC_ASSERT(a.soft == b.soft);
  RC_ASSERT(a.reflectance == b.reflectance);
  RC_ASSERT(a.ambient_klux == b.ambient_klux);
}

Event any_event() {
  Event e;
  e.t_s = number(0, 1e6);
  e.kind = static_cast<EventKind>(below(kEventKinds));
  const auto maybe = [](double low, double high) {
    return below(2) == 0 ? std::optional(number(low, high)) : std::nullopt;
  };
  const bool fix = e.kind == EventKind::correct;
  if (e.kind == EventKind::goal) e.goal = {point(1000), number(0.01, 1000)};
  if (fix) e.sigma_m = number(0, 10);
  if (fix) e.sigma_deg = number(0, 90);
  if (fix || e.kind == EventKind::place) {
    e.x_m = maybe(-1000, 1000);
    e.y_m = maybe(-1000, 1000);
    e.heading_deg = maybe(-360, 360);
  }
  if (e.kind == EventKind::param) {
    const std::vector<ParamEntry> list = param_list({});
    do {
      e.param = bits() % list.size();
    } while (is_fixed_in_a_run(list[e.param].key));
    const auto span = static_cast<std::uint64_t>(list[e.param].high - list[e.param].low) + 1;
    e.raw = list[e.param].low + static_cast<std::int64_t>(bits() % span);
  }
  if (e.kind == EventKind::table && below(2) == 0) e.file = "a" + any_name();
  if (e.kind == EventKind::frames_lost) e.for_s = number(0.001, 1e6);
  return e;
}

void same(const std::vector<Event>& a, const std::vector<Event>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    RC_ASSERT(a[i].t_s == b[i].t_s && a[i].kind == b[i].kind && a[i].file == b[i].file);
    RC_ASSERT(a[i].goal.at.x == b[i].goal.at.x && a[i].goal.at.y == b[i].goal.at.y);
    RC_ASSERT(a[i].goal.tolerance_m == b[i].goal.tolerance_m);
    RC_ASSERT(a[i].x_m == b[i].x_m && a[i].y_m == b[i].y_m && a[i].heading_deg == b[i].heading_deg);
    RC_ASSERT(a[i].sigma_m == b[i].sigma_m && a[i].sigma_deg == b[i].sigma_deg);
    RC_ASSERT(a[i].param == b[i].param && a[i].raw == b[i].raw && a[i].for_s == b[i].for_s);
  }
}

Scenario any_scenario() {
  Scenario s;
  s.name = any_name();
  s.seed = bits() >> 1;
  s.time_limit_s = number(1, 5000);
  s.start.at = point(50);
  s.goal = {point(50), number(0.01, 2)};
  s.start.heading = below(3) == 0 ? bearing(s.start.at, s.goal.at) : number(-360, 360) * kRadPerDeg;
  if (below(2) == 0) {
    Shuffle shuffle{s.robot};
    for_each_param(s.robot, shuffle);
    // No robot needs more than 8 of its counts.
    if (!tolerance_fault(s).empty()) s.goal.tolerance_m = number(0.08, 2);
  }
  if (below(2) == 0)
    s.bounds = Bounds{{number(-90, -60), number(-90, -60)}, {number(60, 90), number(60, 90)}};
  for (int i = below(5); i > 0; --i) {
    try_add(s, [](Scenario& t) { t.discs.push_back({point(40), number(0.01, 5)}); });
    try_add(s, [](Scenario& t) { t.polygons.push_back(star(point(40))); });
    try_add(s, [](Scenario& t) { t.walls.push_back({point(40), point(41), point(42)}); });
    try_add(s, [](Scenario& t) {
      const Vec2 a = point(40);
      t.movers.push_back({a, number(0.01, 1), {point(43), a, point(44)}, number(0, 2)});
    });
  }
  if (below(2) == 0) {
    for (const NoiseKey& k : kNoiseKeys) s.noise.*k.field = number(0, k.limits.high);
  }
  if (below(2) == 0) {
    s.sensor = any_sensor();
  }
  for (int i = below(6); i > 0; --i) s.events.push_back(any_event());
  return s;
}

void same(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) RC_ASSERT(a[i].x == b[i].x && a[i].y == b[i].y);
}
void same(Vec2 a, Vec2 b) { same(std::vector<Vec2>{a}, std::vector<Vec2>{b}); }

void same_outlines(const std::vector<std::vector<Vec2>>& a, const std::vector<std::vector<Vec2>>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) same(a[i], b[i]);
}

void same_obstacles(const Scenario& a, const Scenario& b) {
  RC_ASSERT(a.bounds.has_value() == b.bounds.has_value());
  if (a.bounds) same({a.bounds->min, a.bounds->max}, {b.bounds->min, b.bounds->max});
  RC_ASSERT(a.discs.size() == b.discs.size());
  for (std::size_t i = 0; i < a.discs.size(); ++i) {
    same(a.discs[i].center, b.discs[i].center);
    RC_ASSERT(a.discs[i].radius == b.discs[i].radius);
  }
  same_outlines(a.polygons, b.polygons);
  same_outlines(a.walls, b.walls);
  RC_ASSERT(a.movers.size() == b.movers.size());
  for (std::size_t i = 0; i < a.movers.size(); ++i) {
    same(a.movers[i].center, b.movers[i].center);
    same(a.movers[i].path, b.movers[i].path);
    RC_ASSERT(a.movers[i].radius_m == b.movers[i].radius_m);
    RC_ASSERT(a.movers[i].speed_mps == b.movers[i].speed_mps);
  }
}

RC_GTEST_PROP(RoundTrip, GivesTheSameScenarioBitForBit, ()) {
  const Scenario a = any_scenario();
  RC_PRE(start_fault(a).empty());
  const std::string text = to_toml(a);
  RC_LOG() << text;
  const Scenario b = parse_scenario(text, "text");
  RC_ASSERT(a.name == b.name);
  RC_ASSERT(a.seed == b.seed);
  RC_ASSERT(a.time_limit_s == b.time_limit_s);
  same(a.start.at, b.start.at);
  RC_ASSERT(a.start.heading == b.start.heading);
  same(a.goal.at, b.goal.at);
  RC_ASSERT(a.goal.tolerance_m == b.goal.tolerance_m);
  same_obstacles(a, b);
  for (const NoiseKey& k : kNoiseKeys) RC_ASSERT((a.noise.*k.field) == (b.noise.*k.field));
  same(a.sensor, b.sensor);
  RC_ASSERT(values(a.robot) == values(b.robot));
  same(a.events, b.events);
  RC_ASSERT(to_toml(b) == text);
}

// For any bytes, the result is a scenario or a one-line error.
RC_GTEST_PROP(Parser, AnswersAnyDamagedFileInOneLine, ()) {
  std::string text = to_toml(any_scenario());
  for (int i = 1 + below(4); i > 0; --i) {
    const std::size_t at = bits() % text.size();
    switch (below(3)) {
      case 0: text[at] = static_cast<char>(below(256)); break;
      case 1: text.erase(at, 1 + static_cast<std::size_t>(below(20))); break;
      default: text.insert(at, text.substr(bits() % text.size(), static_cast<std::size_t>(below(30)))); break;
    }
    if (text.empty()) text = "=";
  }
  RC_LOG() << text;
  try {
    const Scenario s = parse_scenario(text, "text");
    RC_ASSERT(start_fault(s).empty());
    RC_ASSERT(check(s.robot) == ParamFault::none);
  } catch (const InputError& error) {
    const std::string message = error.what();
    RC_ASSERT(message.rfind("text:", 0) == 0U);
    RC_ASSERT(message.find('\n') == std::string::npos);
  }
}

}  // namespace
}  // namespace whisker
