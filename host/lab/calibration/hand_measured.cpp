#include "host/lab/calibration/hand_measured.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "host/harness/scenario/error.hpp"

namespace whisker::calibration {
namespace {

constexpr double kMostMetres = 100;

Ratio ratio_of(double x) {
  return Ratio::from_raw(static_cast<std::int32_t>(std::lround(std::min(x, 1.0) * 1e6)));
}

std::int32_t times(std::int32_t value, double factor) {
  return static_cast<std::int32_t>(std::lround(value * factor));
}

std::vector<std::string_view> split(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> all;
  for (;;) {
    const std::size_t comma = line.find(',');
    all.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return all;
    line.remove_prefix(comma + 1);
  }
}

/// Places of the columns; -1: there is none.
struct Columns {
  int side = -1, x = -1, y = -1, believed_x = -1, believed_y = -1;
  std::size_t count = 0;
};

class EndsReader {
 public:
  EndsReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  std::vector<SquareEnd> ends() {
    std::string line;
    ++line_;
    if (!std::getline(in_, line)) fail(0, "the file is empty");
    header(split(line));
    std::vector<SquareEnd> all;
    while (++line_, std::getline(in_, line)) {
      if (line.empty() || line == "\r") continue;
      const auto fields = split(line);
      if (fields.size() != columns_.count) {
        fail(0, fmt::format("{} fields; the header has {}", fields.size(), columns_.count));
      }
      all.push_back(row(fields));
    }
    return all;
  }

 private:
  [[noreturn]] void fail(int column, const std::string& what) const {
    throw InputError(name_, line_, static_cast<std::size_t>(column) + 1, what);
  }

  void header(const std::vector<std::string_view>& names) {
    const auto find = [&](std::string_view name) {
      const auto at = std::find(names.begin(), names.end(), name);
      return at == names.end() ? -1 : static_cast<int>(at - names.begin());
    };
    columns_ = {find("side"),         find("x_m"),          find("y_m"),
                find("believed_x_m"), find("believed_y_m"), names.size()};
    if (columns_.side < 0) fail(0, "no column 'side' in the header");
    if (columns_.x < 0) fail(0, "no column 'x_m' in the header");
    if (columns_.y < 0) fail(0, "no column 'y_m' in the header");
  }

  double metres(const std::vector<std::string_view>& fields, int column) const {
    if (column < 0) return 0;
    const std::string_view field = fields[static_cast<std::size_t>(column)];
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
      fail(column, fmt::format("'{}' is no number", field));
    }
    if (std::abs(value) > kMostMetres) fail(column, fmt::format("{} m: at most {}", field, kMostMetres));
    return value;
  }

  SquareEnd row(const std::vector<std::string_view>& fields) const {
    const std::string_view side = fields[static_cast<std::size_t>(columns_.side)];
    if (side != "left" && side != "right") {
      fail(columns_.side, fmt::format("'{}': the side is left or right", side));
    }
    return {side == "left", metres(fields, columns_.x), metres(fields, columns_.y),
            metres(fields, columns_.believed_x), metres(fields, columns_.believed_y)};
  }

  std::istream& in_;
  const std::string& name_;
  std::size_t line_ = 0;
  Columns columns_;
};

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
  return EndsReader(in, name).ends();
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
