#include <nlohmann/json.hpp>

#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/summary.hpp"

namespace whisker::campaign {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& x) { return x ? Json(rounded(*x)) : Json(nullptr); }

Json object(const std::optional<Estimate>& e) {
  if (!e) return nullptr;
  return {{"value", number(e->value)}, {"low", number(e->low)}, {"high", number(e->high)}};
}

Json missions(const Summary& s) {
  return {{"missions", s.missions},
          {"no_way", s.no_way},
          {"least_seed", s.least_seed},
          {"greatest_seed", s.greatest_seed},
          {"worlds", s.worlds}};
}

Json ratio(const Summary& s) {
  return {{"mean", object(s.ratio_mean)}, {"p50", object(s.ratio_p50)}, {"p95", object(s.ratio_p95)}};
}

std::string text(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json object(const PerMetre& p) { return {{"all", object(p.rate)}, {"p50", object(p.p50)}}; }

/// The causes in the order of check().
Json object(const Refusals& refusals) {
  Json json = Json::object();
  for (std::size_t i = 0; i < refusals.size(); ++i) {
    if (refusals[i] > 0) json[name(static_cast<ParamFault>(i))] = refusals[i];
  }
  return json;
}

}  // namespace

std::string summary_json(const Summary& s) {
  Json json = missions(s);
  json["planners"] = s.planners;
  json["truly_there"] = object(s.truly_there);
  json["success"] = object(s.success);
  json["reached"] = object(s.reached);
  json["off_goal"] = object(s.off_goal);
  json["at_goal"] = object(s.truly_there);  // the key's older name
  json["unreachable"] = object(s.unreachable);
  json["false_unreachable"] = object(s.false_unreachable);
  json["gave_up"] = object(s.gave_up);
  json["contact"] = object(s.contact);
  json["fault"] = object(s.fault);
  json["ratio"] = ratio(s);
  json["s_per_m"] = {{"p50", object(s.s_per_m_p50)}, {"p95", object(s.s_per_m_p95)}};
  json["min_clearance_m"] = {{"p5", object(s.clearance_p5)}};
  json["final_distance_m"] = {{"p50", object(s.final_distance_p50)}, {"p95", object(s.final_distance_p95)}};
  json["estimate_error_m"] = {{"p50", object(s.estimate_error_p50)}, {"p95", object(s.estimate_error_p95)}};
  json["path_m"] = {{"p50", object(s.path_p50)}, {"p95", object(s.path_p95)}};
  json["stops_per_m"] = object(s.stops);
  json["flips_per_m"] = object(s.flips);
  json["looks_per_m"] = object(s.looks);
  json["turned_rad_per_m"] = object(s.turned);
  if (s.random_robots) {
    json["robots"] = "random";
    json["refused_draws"] = object(s.refusals);
  }
  return text(json);
}

std::string scan_json(const Summary& s) {
  Json json = missions(s);
  json["success"] = object(s.success);
  json["reached"] = object(s.reached);
  json["unreachable"] = object(s.unreachable);
  json["false_unreachable"] = object(s.false_unreachable);
  json["ratio"] = ratio(s);
  return text(json);
}

}  // namespace whisker::campaign
