#pragma once

#include <cstdint>
#include <string>

#include "host/harness/hil/bus_pilot.hpp"

namespace whisker::hil {

/// The names of the error bits that are set.
std::string error_names(std::uint16_t errors);

/// Empty: it drives, or could.
std::string waits_for(const can::BaseNode& node, const BusOptions& options);
/// Throws OtherRules. had: digest of the table with which the controller drives; 0: none.
[[noreturn]] void refuse_rules(std::uint32_t had, std::uint32_t wanted);
/// Throws NoCalibration if the controller has refused this order for good.
void refuse_calibration(const can::BaseNode& node, can::Order order);

}  // namespace whisker::hil
