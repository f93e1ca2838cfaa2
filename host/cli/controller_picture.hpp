#pragma once

#include "firmware/fuzzy/engine.hpp"
#include "host/report/fuzzy_picture.hpp"

namespace whisker::cli {

/// The core's engine with a response table, for the pictures. For another table than the core's own, the
/// rules are its answers at the centres of the terms.
report::FuzzyPicture controller_picture(const fuzzy::Engine::Table& table = fuzzy::kDefaultTable);

}  // namespace whisker::cli
