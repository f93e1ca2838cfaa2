#include "host/lab/report/trace.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "host/harness/file/file.hpp"
#include "host/lab/report/units.hpp"

namespace whisker::report {
namespace {

/// Half a unit of the last decimal or less is written without a sign: 0.0000, never -0.0000.
double unsigned_zero(double x, int decimals) {
  return std::fabs(x) * std::pow(10.0, decimals) <= 0.5 ? 0.0 : x;
}

class Row {
 public:
  explicit Row(std::string& out) : out_(out) {}
  Row& number(double x, int decimals) {
    separate();
    fmt::format_to(std::back_inserter(out_), "{:.{}f}", unsigned_zero(x, decimals), decimals);
    return *this;
  }
  Row& count(unsigned n) {
    separate();
    fmt::format_to(std::back_inserter(out_), "{}", n);
    return *this;
  }
  Row& word(const char* text) {
    separate();
    out_ += text;
    return *this;
  }
  Row& range(const hal::RangeReading& reading, const RangefinderParams& sensor) {
    return word(range_text(reading, sensor).c_str());
  }
  void end() { out_ += '\n'; }

 private:
  void separate() {
    if (!first_) out_ += ',';
    first_ = false;
  }
  std::string& out_;
  bool first_ = true;
};

void add_row(std::string& out, const RangefinderParams& sensor, const TickRecord& r) {
  Row row(out);
  row.number(r.t_s, 3).number(r.x_m, 6).number(r.y_m, 6).number(r.heading_rad, 6);
  for (const hal::RangeReading& reading : r.ranges.beam) row.range(reading, sensor);
  row.number(r.v_left_mps, 5)
      .number(r.v_right_mps, 5)
      .word(planning::name(r.mode))
      .word(planning::name(r.why));
  row.count(r.danger_count).count(r.looked ? 1 : 0);
  const auto inner = [&](double x, int decimals) { r.inside ? row.number(x, decimals) : row.word(""); };
  inner(r.d_q7 / 128.0, 4);
  inner(r.r_q7 / 128.0, 4);
  inner(r.sa_q14 / 16384.0, 5);
  inner(r.sd_q14 / 16384.0, 5);
  row.number(r.command.left / 10000.0, 5).number(r.command.right / 10000.0, 5);
  inner(r.est_x_m, 6);
  inner(r.est_y_m, 6);
  inner(r.est_heading_rad, 6);
  row.word(name(r.guide));
  const auto place = [&](double x) { has_place(r.guide) ? row.number(x, 6) : row.word(""); };
  place(r.way_x_m);
  place(r.way_y_m);
  row.count(r.pressed);
  const auto sigma = [&](double x) { r.sigma ? row.number(x, 6) : row.word(""); };
  const localization::PoseSigma of = r.sigma.value_or(localization::PoseSigma{});
  sigma(metres(of.along));
  sigma(metres(of.across));
  sigma(radians(of.heading));
  inner(r.bend_rad, 5);
  inner(r.pace_mps, 5);
  row.end();
}

}  // namespace

std::string range_text(const hal::RangeReading& reading, const RangefinderParams& sensor) {
  switch (reading.status) {
    case hal::RangeStatus::ok: return fmt::format("{:.4f}", reading.mm / 1000.0);
    case hal::RangeStatus::clear: return fmt::format("{:.4f}", metres(sensor.max_range));
    case hal::RangeStatus::too_near: return fmt::format("{:.4f}", metres(sensor.min_range));
    case hal::RangeStatus::invalid:
    case hal::RangeStatus::stale: return "";
  }
  return "";
}

const char* const kTraceHeader =
    "t_s,x_m,y_m,heading_rad,left_m,front_m,right_m,v_left_mps,v_right_mps,state,why,"
    "t,looked,d,r,sa,sd,cmd_left_mps,cmd_right_mps,est_x_m,est_y_m,est_heading_rad,guide,way_x_m,way_y_m,"
    "pressed,sigma_along_m,sigma_across_m,sigma_heading_rad,bend_rad,pace_mps";

std::string trace_csv(const RunLog& log) {
  const std::vector<TickRecord>& records = log.ticks().records;
  std::string out = kTraceHeader;
  out += '\n';
  out.reserve(out.size() + records.size() * 200);
  for (const TickRecord& r : records) add_row(out, log.setting().scenario.robot.rangefinders, r);
  return out;
}

void write_trace(const std::string& path, const RunLog& log) { files::write(path, trace_csv(log)); }

}  // namespace whisker::report
