#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/harness/scenario/bearing.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/calibration/log.hpp"

namespace whisker::calibration {
namespace {

constexpr double kRounding = 0.00006;  // m, of four decimals

std::vector<std::string_view> fields_of(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> all;
  for (;;) {
    const std::size_t comma = line.find(',');
    all.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return all;
    line.remove_prefix(comma + 1);
  }
}

struct Row {
  double t_s = 0;
  double heading_rad = 0;
  double x_m = 0, y_m = 0;
  std::array<std::optional<double>, hal::kBeams> metres;  ///< none: an empty field
};

class Reader {
 public:
  Reader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  std::vector<Row> rows() {
    std::string line;
    if (!next(line)) fail(0, "is empty");
    header(fields_of(line));
    std::vector<Row> all;
    while (next(line)) {
      if (line.empty() || line == "\r") continue;
      const auto fields = fields_of(line);
      if (fields.size() != columns_) {
        fail(0, fmt::format("{} fields; the header has {}", fields.size(), columns_));
      }
      if (all.empty() && heading_ != plain_heading_ && fields[heading_].empty()) heading_ = plain_heading_;
      all.push_back(row(fields));
      if (all.size() > 1 && all.back().t_s <= all[all.size() - 2].t_s) fail(time_, "t_s does not rise");
    }
    return all;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  bool next(std::string& line) {
    ++line_;
    return static_cast<bool>(std::getline(in_, line));
  }
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw InputError(name_, line_, column + 1, what);
  }

  static std::size_t find(const std::vector<std::string_view>& names, std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? kNone : static_cast<std::size_t>(at - names.begin());
  }
  std::size_t need(const std::vector<std::string_view>& names, std::string_view name) const {
    const std::size_t at = find(names, name);
    if (at == kNone) fail(0, fmt::format("no column '{}' in the header of a trace", name));
    return at;
  }

  void header(const std::vector<std::string_view>& names) {
    columns_ = names.size();
    time_ = need(names, "t_s");
    heading_ = find(names, "est_heading_rad");
    plain_heading_ = find(names, "heading_rad");
    if (heading_ == kNone) heading_ = need(names, "heading_rad");
    if (plain_heading_ == kNone) plain_heading_ = heading_;
    x_ = find(names, "est_x_m");
    y_ = find(names, "est_y_m");
    beams_ = {need(names, "left_m"), need(names, "front_m"), need(names, "right_m")};
  }

  double number(const std::vector<std::string_view>& fields, std::size_t column) const {
    const std::string_view text = fields[column];
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc{} || end != text.data() + text.size() || !(std::fabs(x) < 1e9)) {
      fail(column, fmt::format("'{}' is no number", text));
    }
    return x;
  }

  Row row(const std::vector<std::string_view>& fields) const {
    Row r;
    r.t_s = number(fields, time_);
    r.heading_rad = number(fields, heading_);
    if (x_ != kNone && y_ != kNone && !fields[x_].empty()) {
      r.x_m = number(fields, x_);
      r.y_m = number(fields, y_);
    }
    for (std::size_t i = 0; i < r.metres.size(); ++i) {
      if (fields[beams_[i]].empty()) continue;
      r.metres[i] = number(fields, beams_[i]);
      if (*r.metres[i] < 0) fail(beams_[i], "a distance below 0");
    }
    return r;
  }

  std::istream& in_;
  std::string name_;
  std::size_t line_ = 0;
  std::size_t columns_ = 0, time_ = 0, heading_ = 0, plain_heading_ = 0;
  std::size_t x_ = kNone, y_ = kNone;
  std::array<std::size_t, hal::kBeams> beams_{};
};

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
  std::vector<Row> rows = Reader(in, name).rows();
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
