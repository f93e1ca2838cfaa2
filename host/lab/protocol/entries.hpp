#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/can/table.hpp"

namespace whisker::protocol {

/// A message of one sender.
struct Entry {
  const can::Message* message;
  std::uint32_t id;
  std::string name;    ///< unique in a robot
  std::string sender;  ///< Controller, Base, or "" for any sender
};

/// The messages of one robot, by identifier.
std::vector<Entry> entries_of(std::uint8_t robot);

/// Crc and Counter, which are in every message.
extern const can::Signal kProtection[2];

/// A raw value in the unit of the signal, as short as possible.
std::string physical(const can::Signal& signal, std::int64_t raw);

}  // namespace whisker::protocol
