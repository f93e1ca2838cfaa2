#include "host/run/fix_source.hpp"

#include "host/run/spec.hpp"

namespace whisker {
namespace {

localization::PoseSigma fix_sigma(const sim::NoiseSpec& noise) {
  const Pose sigma = fixed_pose({{noise.fix_sigma_m, 0}, noise.fix_sigma_rad});
  return {sigma.at.x, sigma.at.x, sigma.heading};
}

}  // namespace

FixSource::FixSource(const Scenario& scenario)
    : fixes_(noise_spec(scenario.noise), scenario.seed), sigma_(fix_sigma(noise_spec(scenario.noise))) {}

std::optional<localization::UncertainPose> FixSource::take(const sim::Plant& plant) {
  sim::Pose fix;
  if (!fixes_.take(plant.pose(), plant.path_length(), fix)) return std::nullopt;
  return localization::UncertainPose{fixed_pose(fix), sigma_};
}

}  // namespace whisker
