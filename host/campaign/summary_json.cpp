#include <nlohmann/json.hpp>

#include "host/campaign/summary.hpp"

namespace whisker::campaign {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& x) { return x ? Json(rounded(*x)) : Json(nullptr); }

Json object(const std::optional<Estimate>& e) {
  if (!e) return nullptr;
  return {{"value", number(e->value)}, {"low", number(e->low)}, {"high", number(e->high)}};
}

Json object(const PerMetre& p) { return {{"all", object(p.rate)}, {"p50", object(p.p50)}}; }

}  // namespace

std::string summary_json(const Summary& s) {
  Json json;
  json["missions"] = s.missions;
  json["no_way"] = s.no_way;
  json["least_seed"] = s.least_seed;
  json["greatest_seed"] = s.greatest_seed;
  json["worlds"] = s.worlds;
  json["planners"] = s.planners;
  json["success"] = object(s.success);
  json["reached"] = object(s.reached);
  json["at_goal"] = object(s.at_goal);
  json["unreachable"] = object(s.unreachable);
  json["false_unreachable"] = object(s.false_unreachable);
  json["gave_up"] = object(s.gave_up);
  json["contact"] = object(s.contact);
  json["fault"] = object(s.fault);
  json["ratio"] = {
      {"mean", object(s.ratio_mean)}, {"p50", object(s.ratio_p50)}, {"p95", object(s.ratio_p95)}};
  json["s_per_m"] = {{"p50", object(s.s_per_m_p50)}, {"p95", object(s.s_per_m_p95)}};
  json["min_clearance_m"] = {{"p5", object(s.clearance_p5)}};
  json["estimate_error_m"] = {{"p50", object(s.estimate_error_p50)}, {"p95", object(s.estimate_error_p95)}};
  json["stops_per_m"] = object(s.stops);
  json["flips_per_m"] = object(s.flips);
  json["looks_per_m"] = object(s.looks);
  json["turned_rad_per_m"] = object(s.turned);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace whisker::campaign
