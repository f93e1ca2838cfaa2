#include "host/harness/hil/figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace whisker::hil {
namespace {

/// In percent of the bus capacity over the simulated time. In lockstep an hour of frames may pass in a
/// second, so wall-clock time would not give the load.
double load_percent(const Figures& f, double bitrate) {
  return f.run_s > 0 ? 100.0 * static_cast<double>(f.bits) / (f.run_s * bitrate) : 0.0;
}

/// As in a robot file.
double in_file(calibration::Quantity q, std::int32_t raw) {
  return q == calibration::Quantity::counts_per_metre ? raw : raw / 1e6;
}

nlohmann::ordered_json calibration_json(const can::Calibrated& found) {
  nlohmann::ordered_json json = {{"trouble", name(found.trouble)}, {"stored", name(found.stored)}};
  for (int i = 0; i < calibration::kQuantities; ++i) {
    const auto q = static_cast<calibration::Quantity>(i);
    if (!found[q].known()) continue;
    json["values"][name(q)] = {{"value", in_file(q, found[q].value)}, {"sigma", found[q].sigma.raw() / 1e6}};
  }
  return json;
}

std::string calibration_words(const can::Calibrated& found) {
  const bool good = found.trouble == planning::Trouble::none;
  std::string words =
      fmt::format("\ncalibration: {}; the controller's storage: {}",
                  good ? "measured" : fmt::format("no result: {}", name(found.trouble)), name(found.stored));
  for (int i = 0; i < calibration::kQuantities; ++i) {
    const auto q = static_cast<calibration::Quantity>(i);
    if (!found[q].known()) continue;
    words += fmt::format("\n{} = {}  # +- {:.4f} %", name(q), in_file(q, found[q].value),
                         found[q].sigma.raw() * 1e-4);
  }
  return words;
}

double rounded(double x) { return std::round(x * 100.0) / 100.0; }

}  // namespace

std::string figures_json(const Figures& f, double bitrate) {
  nlohmann::ordered_json json;
  json["sets"] = f.sets;
  json["resent"] = f.resent;
  json["deadline_misses"] = f.misses;
  json["late_periods"] = f.late;
  json["round_trip_us"] = {{"p50", percentile(f.round_trip_us, 0.5)},
                           {"p99", percentile(f.round_trip_us, 0.99)},
                           {"max", percentile(f.round_trip_us, 1.0)}};
  json["frames"] = f.frames;
  json["load_percent"] = rounded(load_percent(f, bitrate));
  json["ticks_per_s"] = f.wall_s > 0 ? rounded(static_cast<double>(f.sets) / f.wall_s) : 0.0;
  json["lost"] = f.health.lost;
  json["refused"] = f.health.crc + f.health.malformed + f.health.repeated + f.health.out_of_sequence +
                    f.health.out_of_range + f.health.stale;
  json["safe_stops"] = f.health.stops;
  json["resumed"] = f.resumed;
  if (f.fixes > 0) {
    json["fixes"] = {{"sent", f.fixes}, {"accepted", f.fixes_accepted}, {"refused", f.fixes_refused}};
  }
  if (f.calibrated) json["calibration"] = calibration_json(*f.calibrated);
  return json.dump();
}

std::string figures_words(const Figures& f, double bitrate) {
  const std::string words = fmt::format(
      "{} missed, {} resent, round trip {} us (99 %: {} us), {} frames, load of the bus in real time {:.1f} "
      "%",
      f.misses, f.resent, percentile(f.round_trip_us, 0.5), percentile(f.round_trip_us, 0.99), f.frames,
      load_percent(f, bitrate));
  return f.calibrated ? words + calibration_words(*f.calibrated) : words;
}

std::uint32_t percentile(std::vector<std::uint32_t> samples, double part) {
  if (samples.empty()) return 0;
  const double rank = std::ceil(part * static_cast<double>(samples.size()));
  const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
  const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(std::min(index, samples.size() - 1));
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

}  // namespace whisker::hil
