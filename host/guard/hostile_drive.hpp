/// One drive of the adversary.
#pragma once

#include <cstdint>

#include "host/guard/drive.hpp"

namespace whisker::guard {

/// Up to 20 s of hostile commands in a random world of any class, beginning beside an obstacle, with random
/// accepted gaps between ticks in one drive of three. The same seed gives the same drive. seed < 2^62.
/// `table`: see Options::table.
Result hostile_drive(std::uint64_t seed, bool noise, const Params& robot,
                     const fuzzy::Bilinear::Table* table = nullptr);

}  // namespace whisker::guard
