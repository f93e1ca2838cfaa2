/// The thesis's controller, computed exactly in double: an input for the pictures, no part of the product.
#pragma once

#include "host/report/fuzzy_picture.hpp"

namespace whisker::testing {

/// Variables as the thesis states them, a rule base in its spirit, min for AND, weighted average of the
/// rules.
report::FuzzyPicture thesis_picture();

}  // namespace whisker::testing
