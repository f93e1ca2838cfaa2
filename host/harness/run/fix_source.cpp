#include "host/harness/run/fix_source.hpp"

#include "host/harness/run/spec.hpp"

namespace whisker {
FixSource::FixSource(const Scenario& scenario)
    : fixes_(noise_spec(scenario.noise), scenario.seed),
      sigma_(fixed_sigma(scenario.noise.fix_sigma_m, noise_spec(scenario.noise).fix_sigma_rad)) {}

std::optional<localization::UncertainPose> FixSource::take(const sim::Plant& plant) {
  sim::Pose fix;
  if (!fixes_.take(plant.pose(), plant.path_length(), fix)) return std::nullopt;
  return localization::UncertainPose{fixed_pose(fix), sigma_};
}

}  // namespace whisker
