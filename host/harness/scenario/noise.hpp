/// The keys of [noise], in the order of a written file.
#pragma once

#include "host/harness/scenario/limits.hpp"
#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker {

struct NoiseKey {
  const char* key;
  double Noise::*field;
  Limits limits;
  const char* about = "";  ///< comment in a written file
};

constexpr NoiseKey kNoiseKeys[] = {
    {"range_sigma_m", &Noise::range_sigma_m, kRangeSigma},
    {"range_dropout", &Noise::range_dropout, kProbability, "readings lost, and saying so"},
    {"range_false_clear", &Noise::range_false_clear, kProbability,
     "readings that wrongly say that nothing is there"},
    {"wheel_scale_sigma", &Noise::wheel_scale_sigma, kWheelScaleSigma, "of each wheel's encoder, once a run"},
    {"heading_drift_deg_per_sqrt_m", &Noise::heading_drift_deg_per_sqrt_m, kHeadingDrift},
    {"wheel_scale_common_sigma", &Noise::wheel_scale_common_sigma, kWheelScaleSigma,
     "of both encoders, once a run"},
    {"wheel_slip", &Noise::wheel_slip, kWheelSlip, "mean share of travel lost while speeding up"},
    {"motor_lag_shorter", &Noise::motor_lag_shorter, kProbability, "share by which the wheels are quicker"},
    {"gyro_bias_dps", &Noise::gyro_bias_dps, kGyroBias, "standard deviation, once a run"},
    {"gyro_warm_up_dps", &Noise::gyro_warm_up_dps, kGyroBias, "of the change of the bias in 10 minutes"},
    {"gyro_walk_deg_per_sqrt_h", &Noise::gyro_walk_deg_per_sqrt_h, kGyroWalk, "angle random walk"},
    {"gyro_scale_sigma", &Noise::gyro_scale_sigma, kGyroScaleSigma, "once a run"},
    {"fix_every_m", &Noise::fix_every_m, kFixEvery, "driven between two fixes of the pose"},
    {"fix_sigma_m", &Noise::fix_sigma_m, kFixSigma, "of each coordinate"},
    {"fix_sigma_deg", &Noise::fix_sigma_deg, kFixTurnSigma},
};

std::vector<std::string_view> noise_keys();
/// Sets the keys that the table has.
void read_noise(const TableReader& table, Noise& noise);
/// The lines of the keys that are not 0.
std::string noise_toml(const Noise& noise);

}  // namespace whisker
