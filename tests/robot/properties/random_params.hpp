/// Parameter sets that check() accepts, including the limits of every range.
#pragma once

#include "firmware/params.hpp"
#include "tests/robot/properties/bits.hpp"

namespace whisker::test {

Params random_params(Bits& bits);

/// A robot similar to the reference: its scaled geometry, and other wheels, rates, latencies and steps.
Params robot_like_the_reference(Bits& bits);

}  // namespace whisker::test
