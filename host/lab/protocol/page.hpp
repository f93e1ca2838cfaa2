#pragma once

#include <cstdint>
#include <string>

namespace whisker::protocol {

/// docs/protocol.md: every message with its signals, times, errors and parameters.
std::string page();

/// The messages of one robot (1..7) and of the E-stop for all robots, as a DBC file. Messages of both nodes
/// appear twice: HeartbeatController, HeartbeatBase.
std::string dbc(std::uint8_t robot);

}  // namespace whisker::protocol
