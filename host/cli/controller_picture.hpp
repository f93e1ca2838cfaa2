#pragma once

#include "host/report/fuzzy_picture.hpp"

namespace whisker::cli {

/// The core's own rules and engine, for the pictures.
report::FuzzyPicture controller_picture();

}  // namespace whisker::cli
