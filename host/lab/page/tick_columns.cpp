#include <algorithm>
#include <cmath>

#include "host/lab/page/base64.hpp"
#include "host/lab/page/columns.hpp"
#include "host/lab/page/deflate.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/report/track.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::page {
namespace {

using report::metres;
using report::radians;

constexpr std::int64_t kMilli = 1000;
constexpr std::int64_t kMicro = 1000000;

/// Collects one integer per tick into a column.
class Writer {
 public:
  Writer(Columns& columns, const Ticks& ticks, Detail detail)
      : columns_(columns), ticks_(ticks), finest_(detail == Detail::full ? kMicro : kMilli) {}

  template <class F>
  void tick(const char* name, Order order, std::int64_t per_unit, F&& value_of) {
    std::vector<std::int64_t> values;
    values.reserve(ticks_.records.size());
    for (const TickRecord& r : ticks_.records) values.push_back(static_cast<std::int64_t>(value_of(r)));
    columns_.add(name, order, per_unit, values);
  }
  /// With coarse detail, at most thousandths.
  template <class F>
  void decimal(const char* name, Order order, std::int64_t per_unit, F&& value_of) {
    const std::int64_t units = std::min(per_unit, finest_);
    tick(name, order, units,
         [&](const TickRecord& r) { return std::llround(value_of(r) * static_cast<double>(units)); });
  }
  template <class F>
  void ranges(const char* name, std::int64_t per_unit, F&& value_of) {
    std::vector<std::int64_t> values;
    for (const Health& h : ticks_.health) values.push_back(static_cast<std::int64_t>(value_of(h.ranges)));
    columns_.add(name, Order::differences, per_unit, values);
  }
  void counter(const char* name, std::uint32_t Health::*counter) {
    std::vector<std::int64_t> values;
    for (const Health& h : ticks_.health) values.push_back(h.*counter);
    columns_.add(name, Order::differences, 1, values);
  }

 private:
  Columns& columns_;
  const Ticks& ticks_;
  const std::int64_t finest_;
};

void add_motion(Writer& w) {
  constexpr Order kSmooth = Order::second_differences;
  w.decimal("t_s", kSmooth, 1000, [](const TickRecord& r) { return r.t_s; });
  w.decimal("x_m", kSmooth, kMicro, [](const TickRecord& r) { return r.x_m; });
  w.decimal("y_m", kSmooth, kMicro, [](const TickRecord& r) { return r.y_m; });
  w.decimal("heading_rad", kSmooth, kMicro, [](const TickRecord& r) { return r.heading_rad; });
  w.decimal("est_x_m", kSmooth, kMicro, [](const TickRecord& r) { return r.est_x_m; });
  w.decimal("est_y_m", kSmooth, kMicro, [](const TickRecord& r) { return r.est_y_m; });
  w.decimal("est_heading_rad", kSmooth, kMicro, [](const TickRecord& r) { return r.est_heading_rad; });
  w.decimal("v_left_mps", kSmooth, 100000, [](const TickRecord& r) { return r.v_left_mps; });
  w.decimal("v_right_mps", kSmooth, 100000, [](const TickRecord& r) { return r.v_right_mps; });
  w.decimal("cmd_left_mps", Order::differences, 10000,
            [](const TickRecord& r) { return r.command.left / 10000.0; });
  w.decimal("cmd_right_mps", Order::differences, 10000,
            [](const TickRecord& r) { return r.command.right / 10000.0; });
}

/// 0 where the standard deviations are unknown: known ones are at least 3 mm.
void add_sigma(Writer& w) {
  const auto of = [](const TickRecord& r) { return r.sigma.value_or(localization::PoseSigma{}); };
  w.decimal("sigma_along_m", Order::differences, kMicro,
            [&](const TickRecord& r) { return metres(of(r).along); });
  w.decimal("sigma_across_m", Order::differences, kMicro,
            [&](const TickRecord& r) { return metres(of(r).across); });
  w.decimal("sigma_heading_rad", Order::differences, kMicro,
            [&](const TickRecord& r) { return radians(of(r).heading); });
}

/// A lost reading repeats the previous value; the status column marks it as lost.
void add_ranges(Writer& w) {
  constexpr const char* kRanges[hal::kBeams] = {"left_m", "front_m", "right_m"};
  constexpr const char* kStatus[hal::kBeams] = {"left_status", "front_status", "right_status"};
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    std::int64_t last = 0;
    w.tick(kRanges[beam], Order::differences, 1000, [&](const TickRecord& r) {
      const hal::RangeReading& reading = r.ranges.beam[beam];
      if (reading.status == hal::RangeStatus::ok) last = reading.mm;
      return last;
    });
    w.tick(kStatus[beam], Order::differences, 1,
           [&](const TickRecord& r) { return static_cast<int>(r.ranges.beam[beam].status); });
  }
}

void add_decisions(Writer& w) {
  constexpr Order kSteady = Order::differences;
  w.tick("state", kSteady, 1, [](const TickRecord& r) { return static_cast<int>(r.mode); });
  w.tick("why", kSteady, 1, [](const TickRecord& r) { return static_cast<int>(r.why); });
  w.tick("doing", kSteady, 1, [](const TickRecord& r) { return static_cast<int>(report::doing(r)); });
  w.tick("t", kSteady, 1, [](const TickRecord& r) { return r.danger_count; });
  w.tick("looked", Order::values, 1, [](const TickRecord& r) { return r.looked; });
  w.tick("d", kSteady, 128, [](const TickRecord& r) { return r.d_q7; });
  w.tick("r", kSteady, 128, [](const TickRecord& r) { return r.r_q7; });
  w.tick("sa", kSteady, 16384, [](const TickRecord& r) { return r.sa_q14; });
  w.tick("sd", kSteady, 16384, [](const TickRecord& r) { return r.sd_q14; });
  w.decimal("bend_rad", kSteady, 10000, [](const TickRecord& r) { return r.bend_rad; });
  w.decimal("pace_mps", kSteady, 1000, [](const TickRecord& r) { return r.pace_mps; });
  w.tick("cell_d", kSteady, 1, [](const TickRecord& r) { return r.cell.distance; });
  w.tick("cell_r", kSteady, 1, [](const TickRecord& r) { return r.cell.bias; });
  w.tick("guide", kSteady, 1, [](const TickRecord& r) { return static_cast<int>(r.guide); });
  w.tick("pressed", kSteady, 1, [](const TickRecord& r) { return r.pressed; });
  w.decimal("way_x_m", kSteady, kMicro, [](const TickRecord& r) { return r.way_x_m; });
  w.decimal("way_y_m", kSteady, kMicro, [](const TickRecord& r) { return r.way_y_m; });
}

void add_health(Columns& columns, Writer& w, const std::vector<Health>& health) {
  std::vector<std::int64_t> faults;
  for (const Health& h : health) faults.push_back(static_cast<int>(h.fault));
  columns.add("fault", Order::differences, 1, faults);
  w.counter("range_refused", &Health::range_refused);
  w.counter("range_invalid", &Health::range_invalid);
  w.counter("range_stale", &Health::range_stale);
  w.counter("range_stuck", &Health::range_stuck);
  w.counter("range_out_of_range", &Health::range_out_of_range);
  w.counter("drive_refused", &Health::drive_refused);
  w.counter("encoder_refused", &Health::encoder_refused);
  w.counter("encoder_jumps", &Health::encoder_jumps);
  w.counter("wheel_stalls", &Health::wheel_stalls);
  w.counter("unsteady_looks", &Health::unsteady_looks);
  w.counter("no_progress", &Health::no_progress);
  w.counter("pose_out_of_range", &Health::pose_out_of_range);
  w.counter("wheel_runaways", &Health::wheel_runaways);
  w.counter("late_ticks", &Health::late_ticks);
  w.counter("clock_jumps", &Health::clock_jumps);
  w.counter("bumps", &Health::bumps);
  w.counter("bumper_refused", &Health::bumper_refused);
  w.counter("bumper_stuck", &Health::bumper_stuck);
  w.ranges("range_level", 1, [](const RangeTrust& r) { return static_cast<int>(r.level); });
  w.ranges("contradictions_per_m", RangeTrust::kOnePerMetre,
           [](const RangeTrust& r) { return r.contradictions; });
  w.ranges("phantom_share", INT64_C(1) << 16, [](const RangeTrust& r) { return r.phantoms; });
  w.ranges("false_clear_share", INT64_C(1) << 16, [](const RangeTrust& r) { return r.false_clears; });
  w.ranges("incidence_seen_deg", 1, [](const RangeTrust& r) { return r.incidence_deg; });
}

void add_film(Columns& columns, const Frames& film) {
  columns.add("film_tick", Order::second_differences, 1, film.ticks);
  columns.add("film_changes", Order::values, 1, film.changes);
  columns.add("film_word", Order::differences, 1, film.words);
  columns.add("film_bits", Order::values, 1, film.bits);
}

void add_map(Columns& columns, const MapFrames& map) {
  columns.add("map_tick", Order::second_differences, 1, map.pictures.ticks);
  columns.add("map_x", Order::differences, 1, map.x);
  columns.add("map_y", Order::differences, 1, map.y);
  columns.add("map_changes", Order::values, 1, map.pictures.changes);
  columns.add("map_word", Order::differences, 1, map.pictures.words);
  columns.add("map_bits", Order::values, 1, map.pictures.bits);
}

Json columns_data(const Columns& columns) {
  Json list = Json::array();
  for (const Column& c : columns.list())
    list.push_back({c.name, static_cast<int>(c.order), c.per_unit, c.count});
  return list;
}

}  // namespace

void add_ticks(Columns& columns, const Ticks& ticks, Detail detail) {
  Writer writer(columns, ticks, detail);
  add_motion(writer);
  add_sigma(writer);
  add_ranges(writer);
  add_decisions(writer);
  add_health(columns, writer, ticks.health);
  add_film(columns, ticks.frames);
  add_map(columns, ticks.map);
}

Packed packed(const Columns& columns) { return {columns_data(columns), base64(deflated(columns.bytes()))}; }

Packed packed(const Ticks& ticks, Detail detail) {
  Columns columns;
  add_ticks(columns, ticks, detail);
  return packed(columns);
}

}  // namespace whisker::page
