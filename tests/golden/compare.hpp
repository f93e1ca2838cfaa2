/// Judges a chip's answers to the golden recording.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/golden/messages.hpp"

namespace whisker::golden {

/// Results of one stream.
struct Cost {
  std::string name;
  std::uint64_t ticks = 0;
  std::uint64_t work = 0;   ///< of all its ticks together, see hal::Meter
  std::uint32_t worst = 0;  ///< of one tick
};

struct Judgement {
  std::string difference;  ///< stream, tick and field of the first one, and both values; "" for none
  Total total;             ///< as the chip reports
  std::vector<Cost> costs;
};

/// `recorded` with `index` is the input of the chip, `expected` the answer of the core in this process. Work
/// and stack are not compared. Throws std::runtime_error for bytes that are not a recording.
Judgement judge(const Bytes& recorded, const std::string& index, const Bytes& expected,
                const Bytes& answered);

}  // namespace whisker::golden
