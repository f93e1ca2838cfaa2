/// Parameter sets that check() accepts, the ends of every range among them.
#pragma once

#include "firmware/params.hpp"
#include "tests/robot/properties/bits.hpp"

namespace whisker::test {

Params random_params(Bits& bits);

}  // namespace whisker::test
