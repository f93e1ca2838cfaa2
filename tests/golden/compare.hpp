/// Judges what a chip answered to the golden recording.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/chip/messages.hpp"

namespace whisker::golden {

/// Of one stream.
struct Cost {
  std::string name;
  std::uint64_t ticks = 0;
  std::uint64_t work = 0;   ///< of all its ticks together, see hal::Meter
  std::uint32_t worst = 0;  ///< of one tick
};

struct Judgement {
  std::string difference;  ///< stream, tick and field of the first one, and both values; "" for none
  link::Total total;       ///< as the chip says
  std::vector<Cost> costs;
};

/// `recorded` with `index` is what the chip was told, `expected` what the core answers in this process.
/// Work, stack and room for maps are not compared. Throws std::runtime_error on bytes that are no recording.
Judgement judge(const chip::Bytes& recorded, const std::string& index, const chip::Bytes& expected,
                const chip::Bytes& answered);

}  // namespace whisker::golden
