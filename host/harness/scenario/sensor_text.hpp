/// The `[sensor]` table of scenario and robot files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/harness/scenario/reader.hpp"
#include "host/harness/scenario/sensor.hpp"

namespace whisker {

/// Every key of the table.
std::vector<std::string_view> sensor_keys();
/// Takes a model first, then the other keys. Keeps what neither sets.
void read_sensor(const TableReader& table, Sensor& sensor);
/// The table, with what differs from the model or, without one, from the default; empty if nothing does.
std::string sensor_toml(const Sensor& sensor);

}  // namespace whisker
