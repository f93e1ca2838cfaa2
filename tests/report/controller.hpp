/// The thesis's controller, computed exactly in double: an input for the pictures, not part of the product.
#pragma once

#include "host/lab/report/fuzzy_picture.hpp"

namespace whisker::testing {

/// Variables as in the thesis, a similar rule base, minimum for AND, weighted average of the rules.
report::FuzzyPicture thesis_picture();

}  // namespace whisker::testing
