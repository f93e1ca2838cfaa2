#include "host/guard/trace.hpp"

#include <fmt/core.h>

#include "host/report/trace.hpp"

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

}  // namespace whisker::guard
