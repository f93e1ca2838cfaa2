#include "host/calibration/sample.hpp"

namespace whisker::calibration {
namespace {

double metres(Length l) { return l.raw() * 1e-6; }
double degrees(Angle a) { return a.wrapped() * (180.0 / 2147483648.0); }

}  // namespace

Believed believed(const Params& params, int beam) {
  const Mount m = mount(params.rangefinders, beam);
  return {degrees(m.axis),
          degrees(m.half_cone),
          metres(m.apex.x),
          metres(m.apex.y),
          metres(min_range(params.rangefinders, beam)),
          metres(max_range(params.rangefinders, beam))};
}

bool sample_of(const hal::RangeReading& reading, const Believed& beam, Sample& sample) {
  switch (reading.status) {
    case hal::RangeStatus::ok:
      sample.reading = Reading::echo;
      sample.metres = reading.mm * 1e-3;
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

}  // namespace whisker::calibration
