#include "host/harness/scenario/sensor.hpp"

#include <cmath>

namespace whisker {

double echo_share(const Sensor& s) {
  double share = 1;
  if (s.reflectance < s.reflectance_reference) share = std::sqrt(s.reflectance / s.reflectance_reference);
  if (s.ambient_klux > 0 && s.ambient_knee_klux > 0) {
    share /= std::sqrt(std::sqrt(1 + s.ambient_klux / s.ambient_knee_klux));
  }
  return share;
}

}  // namespace whisker
