#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/calibration/log.hpp"

namespace whisker::calibration {
namespace {

constexpr double kRounding = 0.00006;  // m, of four decimals

struct Row {
  double t_s = 0;
  double heading_rad = 0;
  double x_m = 0, y_m = 0;
  std::array<std::optional<double>, hal::kBeams> metres;  ///< none: an empty field
};

std::vector<Row> read_rows(std::istream& in, const std::string& name) {
  CsvReader csv(in, name);
  const std::size_t time = csv.need("t_s"), plain = csv.find("heading_rad");
  std::size_t heading = csv.find("est_heading_rad");
  if (heading == CsvReader::kNone) heading = csv.need("heading_rad");
  const std::size_t x = csv.find("est_x_m"), y = csv.find("est_y_m");
  const std::array<std::size_t, hal::kBeams> beams{csv.need("left_m"), csv.need("front_m"),
                                                   csv.need("right_m")};
  std::vector<Row> all;
  while (csv.next()) {
    if (all.empty() && plain != CsvReader::kNone && csv.text(heading).empty()) heading = plain;
    Row r;
    r.t_s = csv.number(time);
    r.heading_rad = csv.number(heading);
    if (x != CsvReader::kNone && y != CsvReader::kNone && !csv.text(x).empty()) {
      r.x_m = csv.number(x);
      r.y_m = csv.number(y);
    }
    for (std::size_t i = 0; i < beams.size(); ++i) {
      if (csv.text(beams[i]).empty()) continue;
      r.metres[i] = csv.number(beams[i]);
      if (*r.metres[i] < 0) csv.fail(beams[i], "a distance below 0");
    }
    if (!all.empty() && r.t_s <= all.back().t_s) csv.fail(time, "t_s does not rise");
    all.push_back(r);
  }
  return all;
}

/// The heading at a time, between the rows.
double heading_at(const std::vector<Row>& rows, double t_s) {
  const auto after =
      std::lower_bound(rows.begin(), rows.end(), t_s, [](const Row& r, double t) { return r.t_s < t; });
  if (after == rows.begin()) return rows.front().heading_rad;
  if (after == rows.end()) return rows.back().heading_rad;
  const Row& before = *(after - 1);
  const double share = (t_s - before.t_s) / (after->t_s - before.t_s);
  return before.heading_rad + (after->heading_rad - before.heading_rad) * share;
}

/// Headings that jump by a turn become continuous.
void unwind(std::vector<Row>& rows) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double step = rows[i].heading_rad - rows[i - 1].heading_rad;
    rows[i].heading_rad = rows[i - 1].heading_rad + std::remainder(step, 360 * kRadPerDeg);
  }
}

Sample sample(const Row& row, std::size_t beam_index, double heading, const Believed& beam) {
  const std::optional<double>& metres = row.metres[beam_index];
  Sample s;
  s.heading_rad = heading;
  s.x_m = row.x_m;
  s.y_m = row.y_m;
  if (!metres) return s;
  const bool clear = *metres > beam.max_range_m - kRounding;
  s.reading = clear ? Reading::clear : Reading::echo;
  s.metres = clear ? 0 : *metres;
  return s;
}

}  // namespace

Log read_trace(std::istream& in, const std::string& name, const Params& params) {
  std::vector<Row> rows = read_rows(in, name);
  if (rows.size() < 2) throw InputError(name, 1, 1, "a trace without rows");
  unwind(rows);
  const Believed beams[hal::kBeams] = {believed(params, 0), believed(params, 1), believed(params, 2)};
  Log log;
  log.start_deg = rows.front().heading_rad / kRadPerDeg;
  const double tick_s = (rows.back().t_s - rows.front().t_s) / static_cast<double>(rows.size() - 1);
  const double period_s = 1.0 / params.rangefinders.rate_hz;
  // A measurement arrives between two rows: half a tick before its row, on average.
  const double age_s = params.rangefinders.latency.raw() * 1e-3 + std::min(tick_s, period_s) / 2;
  const Row* last = nullptr;
  for (const Row& row : rows) {
    const bool same =
        last != nullptr && row.metres == last->metres && row.t_s - last->t_s < period_s - tick_s / 2;
    if (same) continue;
    last = &row;
    const double heading = heading_at(rows, row.t_s - age_s);
    for (std::size_t i = 0; i < log.sweep.size(); ++i) {
      log.sweep[i].push_back(sample(row, i, heading, beams[i]));
    }
  }
  return log;
}

}  // namespace whisker::calibration
