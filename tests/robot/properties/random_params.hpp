/// Parameter sets that check() accepts, the ends of every range among them.
#pragma once

#include "firmware/params.hpp"
#include "tests/robot/properties/bits.hpp"

namespace whisker::test {

Params random_params(Bits& bits);

/// A robot like the reference one: its geometry, but for the scale, and other wheels, rates, latencies and
/// steps.
Params robot_like_the_reference(Bits& bits);

}  // namespace whisker::test
