#include "host/harness/run/core_pilot.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/report/encounters.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/report/track.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::page {
namespace {

using report::metres;
using report::radians;

Json point(sim::Vec2 p) { return {p.x, p.y}; }

Json points(const std::vector<sim::Vec2>& list) {
  Json json = Json::array();
  for (const sim::Vec2 p : list) json.push_back(point(p));
  return json;
}

Json lists(const std::vector<std::vector<sim::Vec2>>& all) {
  Json json = Json::array();
  for (const auto& list : all) json.push_back(points(list));
  return json;
}

Json world_data(const Scenario& s) {
  Json discs = Json::array();
  for (const sim::Disc& d : s.discs) discs.push_back({d.center.x, d.center.y, d.radius});
  Json movers = Json::array();
  for (const Mover& m : s.movers) {
    movers.push_back({{"center", point(m.center)},
                      {"radius", m.radius_m},
                      {"path", points(m.path)},
                      {"speed", m.speed_mps}});
  }
  Json bounds = nullptr;
  if (s.bounds) bounds = {s.bounds->min.x, s.bounds->min.y, s.bounds->max.x, s.bounds->max.y};
  return {{"start", point(s.start.at)}, {"goal", point(s.goal.at)}, {"tolerance", s.goal.tolerance_m},
          {"bounds", bounds},           {"discs", discs},           {"polygons", lists(s.polygons)},
          {"walls", lists(s.walls)},    {"movers", movers}};
}

Json robot_data(const Params& p) {
  const RangefinderParams& sensor = p.rangefinders;
  Json beams = Json::array();
  for (int i = 0; i < hal::kBeams; ++i) {
    const Mount m = mount(sensor, i);
    beams.push_back({{"x", metres(m.apex.x)},
                     {"y", metres(m.apex.y)},
                     {"angle", radians(m.axis)},
                     {"cone", radians(m.half_cone) * 2},
                     {"min_range", metres(sensor.min_range)},
                     {"max_range", metres(sensor.max_range)}});
  }
  return {{"radius", metres(p.body.radius)},
          {"track", metres(p.body.track)},
          {"max_speed", metres(Length::from_raw(p.wheels.max_speed.raw()))},
          {"side_angle", radians(sensor.side_angle)},
          {"cone", radians(sensor.cone)},
          {"min_range", metres(sensor.min_range)},
          {"max_range", metres(sensor.max_range)},
          {"offset", metres(sensor.offset)},
          {"beams", beams},
          {"cell", metres(grid_cell(p))},
          {"base_turn", radians(derived::kBaseTurn)},
          {"period", static_cast<double>(p.safety.period.raw()) / 1000.0}};
}

Json noise_data(const Noise& n) {
  return {{"range_sigma_m", n.range_sigma_m},
          {"range_dropout", n.range_dropout},
          {"range_false_clear", n.range_false_clear},
          {"wheel_scale_sigma", n.wheel_scale_sigma},
          {"heading_drift_deg_per_sqrt_m", n.heading_drift_deg_per_sqrt_m}};
}

Json map_data(const RunSetting& s) {
  const std::int32_t bytes = s.planner ? s.planner->map_bytes : 0;
  if (bytes == 0) return nullptr;
  const planning::GridShape shape = planning::map_shape(bytes);
  return {{"bytes", bytes},
          {"columns", shape.columns()},
          {"rows", shape.rows},
          {"cell", metres(for_body(s.scenario.robot, shape.cell))}};
}

const char* end_name(report::Encounter::End end) {
  switch (end) {
    case report::Encounter::End::none: return "none";
    case report::Encounter::End::left: return "left";
    case report::Encounter::End::wall_lost: return "wall_lost";
    case report::Encounter::End::unreachable: return "unreachable";
  }
  return "?";
}

}  // namespace

Json setting_data(const RunSetting& s) {
  Json planner = nullptr;
  if (s.planner) planner = name(*s.planner);
  return {{"name", s.scenario.name},
          {"planner", planner},
          {"map", map_data(s)},
          {"inside", s.inside},
          {"seed", s.seed},
          {"time_limit", s.scenario.time_limit_s},
          {"world", world_data(s.scenario)},
          {"robot", robot_data(s.scenario.robot)},
          {"noise", noise_data(s.scenario.noise)}};
}

Json edges_data(const std::vector<report::EncounterFinder::Found>& found) {
  const auto tick = [](const std::optional<std::size_t>& i) { return i ? Json(*i) : Json(nullptr); };
  Json edges = Json::array();
  for (const auto& e : found) {
    edges.push_back(
        {{"hit", e.hit}, {"turned", tick(e.turned)}, {"left", tick(e.left)}, {"end", end_name(e.end)}});
  }
  return edges;
}

StoredRun stored(const RunLog& log) {
  report::EncounterFinder finder;
  for (const TickRecord& r : log.ticks().records) finder.add(r);
  Packed columns = packed(log.ticks(), log.detail());
  Json json = setting_data(log.setting());
  json["detail"] = log.detail() == Detail::full ? "full" : "coarse";
  json["result"] = Json::parse(report::result_json(log.result()));
  json["edges"] = edges_data(finder.found());
  json["columns"] = std::move(columns.list);
  return {text_of(json), std::move(columns.data)};
}

}  // namespace whisker::page
