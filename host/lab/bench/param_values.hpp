/// Parameters by name, as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/harness/scenario/param_list.hpp"

namespace whisker::bench {

/// The words of a choice, by raw value; empty for a number.
std::vector<std::string> words_of(std::size_t place);

/// Value and unit: "0.3 m/s", "true", "50".
std::string value_text(const ParamEntry& entry, std::int64_t raw);
/// "0.02 to 3.2 m/s", "agreeing or median".
std::string range_text(const ParamEntry& entry, std::size_t place);

struct Assignment {
  std::size_t place = 0;  ///< in param_list
  std::int64_t raw = 0;
};

/// Parses "NAME=VALUE"; the value is in the parameter's unit, as in a robot file. Throws
/// std::invalid_argument: an unknown name, no value, or a value outside its range, with the range and the
/// nearest value inside.
Assignment parse_assignment(std::string_view text);
/// The place of this name. Throws std::invalid_argument.
std::size_t place_of(std::string_view name);

/// "NAME = VALUE: outside RANGE; the nearest value is VALUE".
std::string outside_text(std::size_t place, std::string_view value, std::int64_t raw);

/// All parameters as a robot file, with unit and range as comments.
std::string saved_toml(const Params& params, std::string_view origin);

}  // namespace whisker::bench
