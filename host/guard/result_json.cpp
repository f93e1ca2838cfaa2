#include "host/guard/result_json.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace whisker::guard {

std::string result_json(const Result& r) {
  const auto outcome = [&] {
    switch (r.end) {
      case End::arrived: return "reached";
      case End::contact: return "contact";
      case End::fault: return "fault";
      case End::time: return "gave_up";
      case End::ended: return "ended";
    }
    return "?";
  };
  nlohmann::ordered_json reasons = nlohmann::ordered_json::object();
  for (int i = 0; i < kGuardReasons; ++i)
    reasons[name(static_cast<GuardReason>(i))] = r.reasons[static_cast<std::size_t>(i)];
  nlohmann::ordered_json json = {{"outcome", outcome()},
                                 {"time_s", r.time_s},
                                 {"path_m", r.path_m},
                                 {"final_distance_m", r.final_distance_m},
                                 {"min_clearance_m", r.min_clearance_m},
                                 {"ticks", r.ticks},
                                 {"hash", fmt::format("{:016x}", r.hash)},
                                 {"detail", r.end == End::fault ? name(r.fault) : ""},
                                 {"granted", r.granted},
                                 {"stops", r.stops},
                                 {"ticks_by_reason", reasons}};
  if (r.events) json["events"] = {{"played", r.events->played}, {"refused", r.events->refused}};
  return json.dump();
}

}  // namespace whisker::guard
