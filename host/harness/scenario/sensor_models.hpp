/// The sensor models that `[sensor] model` names: one row of data each.
#pragma once

#include <string_view>
#include <vector>

#include "host/harness/scenario/sensor.hpp"

namespace whisker {

/// Units and meaning are those of the fields of Sensor, or of the parameters range_rate_hz and
/// range_latency_s.
struct SensorModel {
  const char* name;
  double cone_deg;
  double cone_far_deg;
  double incidence_deg;
  double corner_scatter_m;
  double min_range_m;
  double max_range_m;
  double sigma_m;
  double sigma_share;
  double soft_range_m;
  double reflectance_reference;
  double ambient_knee_klux;
  Lost lost_is;
  // Of the driver at its usual setting; apply() leaves them out, because a robot knows them.
  int rate_hz;
  double latency_s;               ///< from the start of a measurement
  Near near_is = Near::too_near;  ///< apply() sets it
};

/// Every name and every alias.
std::vector<std::string_view> sensor_model_names();
/// The model of this name or alias; null if there is none.
const SensorModel* find_sensor_model(std::string_view name);
/// Sets what the model sets; keeps the mounting, the unit and the surroundings.
void apply(const SensorModel& model, Sensor& sensor);

}  // namespace whisker
