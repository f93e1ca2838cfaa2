#include "host/lab/calibration/sample.hpp"

#include <cmath>

#include "host/harness/run/spec.hpp"

namespace whisker::calibration {
namespace {

double metres(Length l) { return l.raw() * 1e-6; }
double degrees(Angle a) { return a.wrapped() * (180.0 / 2147483648.0); }

constexpr double kKept_s = 0.5;  // the oldest age is 255 ms
constexpr std::uint8_t kUnknownAge = 255;

}  // namespace

Believed believed(const Params& params, int beam) {
  const Mount m = mount(params.rangefinders, beam);
  return {degrees(m.axis),
          degrees(m.half_cone),
          metres(m.apex.x),
          metres(m.apex.y),
          metres(params.rangefinders.min_range),
          metres(params.rangefinders.max_range)};
}

bool sample_of(const hal::RangeReading& reading, const Believed& beam, Sample& sample) {
  switch (reading.status) {
    case hal::RangeStatus::ok:
      sample.metres = reading.mm * 1e-3;
      sample.reading = sample.metres < beam.max_range_m ? Reading::echo : Reading::clear;
      return true;
    case hal::RangeStatus::too_near:
      sample.reading = Reading::echo;
      sample.metres = beam.min_range_m;
      return true;
    case hal::RangeStatus::clear: sample.reading = Reading::clear; return true;
    case hal::RangeStatus::invalid: sample.reading = Reading::lost; return true;
    case hal::RangeStatus::stale: break;
  }
  return false;
}

Collector::Collector(const Params& params)
    : beams_{believed(params, 0), believed(params, 1), believed(params, 2)} {}

bool Collector::heading_at(double t_s, double& heading) const {
  for (std::size_t i = path_.size(); i-- > 0;) {
    if (path_[i].t_s > t_s) continue;
    heading = path_[i].heading;
    if (i + 1 < path_.size()) {
      const Moment &a = path_[i], &b = path_[i + 1];
      heading += (b.heading - a.heading) * (t_s - a.t_s) / (b.t_s - a.t_s);
    }
    return true;
  }
  return false;
}

double Collector::from_start_m() const {
  return 1e-6 * std::hypot(last_.at.x.raw() - first_.at.x.raw(), last_.at.y.raw() - first_.at.y.raw());
}

void Collector::add(double t_s, const Pose& pose, const hal::RangeReadings& readings) {
  if (path_.empty()) {
    first_ = pose;
    start_ = radians(pose.heading);
    path_.push_back({t_s, start_});
  } else {
    path_.push_back({t_s, path_.back().heading + radians(pose.heading - last_.heading)});
  }
  last_ = pose;
  while (path_.front().t_s < t_s - kKept_s) path_.pop_front();
  for (std::size_t i = 0; i < sweep_.size(); ++i) {
    const hal::RangeReading& r = readings.beam[i];
    if (r.status == hal::RangeStatus::stale || r.age_ms == kUnknownAge || sequence_[i] == r.sequence)
      continue;
    sequence_[i] = r.sequence;
    Sample sample;
    sample.x_m = pose.at.x.raw() * 1e-6;
    sample.y_m = pose.at.y.raw() * 1e-6;
    if (!heading_at(t_s - r.age_ms * 1e-3, sample.heading_rad)) continue;
    if (sample_of(r, beams_[i], sample)) sweep_[i].push_back(sample);
  }
}

}  // namespace whisker::calibration
