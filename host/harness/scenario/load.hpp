/// Reads scenario and robot files strictly: anything not in docs/scenario.md is an InputError.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// Files of at most 16 MiB, UTF-8. A robot file, if named, changes the scenario's robot as apply_robot_file()
/// does; start and goal are judged with the result.
Scenario load_scenario(const std::string& file, const std::string& robot_file = {});
/// `name` is the name of the file in messages.
Scenario parse_scenario(std::string_view text, const std::string& name, const std::string& robot_file = {});

/// Sets the parameters that a robot file contains (at its top level, or in [robot]) and keeps the others. On
/// an error, the parameters are unchanged. Its [sensor] and [noise], if any, are only checked.
void apply_robot_file(Params& params, const std::string& file);
/// The keys of must_set() that a robot file does not set, so that the reference robot's value holds.
std::vector<std::string_view> unset_keys(const std::string& file);
/// A body that is a rectangle, m.
struct Rectangle {
  double length;
  double width;
  double axle;  ///< from the front edge to the axle
  /// Of the smallest disc around the middle of the axle that holds it.
  double radius_around_axle() const;
};
/// The same, and sets what its [sensor] contains. Also throws if the disc of the robot does not hold its
/// body.
void apply_robot_file(Params& params, Sensor& sensor, const std::string& file,
                      const Rectangle* body = nullptr);
/// The same for the robot of a scenario, and sets what its [noise] contains; also throws if the new body is
/// in contact at the start.
void apply_robot_file(Scenario& scenario, const std::string& file);

}  // namespace whisker
