/// The `[[event]]` tables of a scenario file.
#pragma once

#include <string>
#include <vector>

#include "host/harness/scenario/event.hpp"
#include "host/harness/scenario/reader.hpp"

namespace whisker {

/// In the order of the file.
std::vector<Event> read_events(const TableReader& top);
/// The tables; empty without events.
std::string events_toml(const std::vector<Event>& events);

}  // namespace whisker
