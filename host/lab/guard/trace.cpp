#include "host/lab/guard/trace.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "host/lab/report/trace.hpp"

namespace whisker::guard {
const char* const kTraceHeader =
    "t_s,x_m,y_m,heading_rad,left_m,front_m,right_m,v_left_mps,v_right_mps,state,why,asked_v_mps,"
    "asked_omega_radps,granted_v,granted_omega";

std::string trace_row(const Moment& m, const RangefinderParams& sensors) {
  std::string row =
      fmt::format("{:.3f},{:.6f},{:.6f},{:.6f}", m.t_s, m.pose.at.x, m.pose.at.y, m.pose.heading);
  for (const hal::RangeReading& beam : m.ranges.beam) {
    row += "," + report::range_text(beam, sensors);
  }
  row += fmt::format(",{:.5f},{:.5f}", m.v_left_mps, m.v_right_mps);
  row += m.status == nullptr ? ",bare," : fmt::format(",guarded,{}", name(m.status->reason));
  row += fmt::format(",{:.5f},{:.5f}", m.asked.forward_mps, m.asked.turning_radps);
  if (m.status == nullptr) return row + ",,";
  return row +
         fmt::format(",{:.4f},{:.4f}", m.status->forward.raw() / 16384.0, m.status->turning.raw() / 16384.0);
}

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
