#include "host/lab/calibration/hand_measured.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/harness/scenario/csv.hpp"

namespace whisker::calibration {
namespace {

constexpr double kMostMetres = 100;

Ratio ratio_of(double x) {
  return Ratio::from_raw(static_cast<std::int32_t>(std::lround(std::min(x, 1.0) * 1e6)));
}

std::int32_t times(std::int32_t value, double factor) {
  return static_cast<std::int32_t>(std::lround(value * factor));
}

}  // namespace

Umbmark take_squares(const std::vector<SquareEnd>& ends, double side_m, double scale_sigma,
                     const Params& params, Values& values) {
  const Umbmark found = umbmark(ends, side_m, params.body.track.raw() * 1e-6, scale_sigma);
  values[Quantity::wheel_ratio] = {times(params.wheels.ratio.raw(), found.wheel_ratio),
                                   ratio_of(found.ratio_sigma)};
  Measured& track = values[Quantity::track];
  const Ratio sigma = ratio_of(found.track_sigma);
  if (!track.known() || sigma < track.sigma) track = {times(params.body.track.raw(), found.track), sigma};
  return found;
}

std::vector<SquareEnd> read_square_ends(std::istream& in, const std::string& name) {
  CsvReader csv(in, name);
  const std::size_t side = csv.need("side"), x = csv.need("x_m"), y = csv.need("y_m");
  const std::size_t believed_x = csv.find("believed_x_m"), believed_y = csv.find("believed_y_m");
  const auto metres = [&](std::size_t column) {
    if (column == CsvReader::kNone) return 0.0;
    const double value = csv.number(column);
    if (std::abs(value) > kMostMetres)
      csv.fail(column, fmt::format("{} m: at most {}", csv.text(column), kMostMetres));
    return value;
  };
  std::vector<SquareEnd> all;
  while (csv.next()) {
    const std::string& word = csv.text(side);
    if (word != "left" && word != "right")
      csv.fail(side, fmt::format("'{}': the side is left or right", word));
    all.push_back({word == "left", metres(x), metres(y), metres(believed_x), metres(believed_y)});
  }
  return all;
}

std::vector<std::string> robot_lines(const Values& values) {
  std::vector<std::string> lines;
  for (int i = 0; i < kQuantities; ++i) {
    const auto q = static_cast<Quantity>(i);
    if (!values[q].known()) continue;
    if (q == Quantity::counts_per_metre) {
      lines.push_back(fmt::format("{} = {}", name(q), values[q].value));
    } else {
      lines.push_back(fmt::format("{} = {:.6f}", name(q), values[q].value * 1e-6));
    }
  }
  return lines;
}

std::vector<std::string> sigma_lines(const Values& values) {
  std::vector<std::string> lines;
  const auto add = [&](const char* key, double sigma) {
    lines.push_back(fmt::format("{} = {:.6f}", key, std::max(sigma, 1e-6)));
  };
  const auto sigma = [&](Quantity q) { return values[q].sigma.raw() * 1e-6; };
  if (values[Quantity::gyro_scale].known()) add("gyro_scale_sigma", sigma(Quantity::gyro_scale));
  // The ratio of two wheels is off by sqrt(2) of one.
  if (values[Quantity::wheel_ratio].known())
    add("wheel_scale_sigma", sigma(Quantity::wheel_ratio) * std::sqrt(0.5));
  if (values[Quantity::counts_per_metre].known()) {
    add("wheel_scale_common_sigma", sigma(Quantity::counts_per_metre));
  }
  return lines;
}

}  // namespace whisker::calibration
