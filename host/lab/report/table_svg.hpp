/// The control response as two heat maps.
#pragma once

#include <string>

#include "host/lab/report/fuzzy_picture.hpp"

namespace whisker::report {

/// SA and SD over R (across) and D (up), with each rule's term and value at its centre and a colour bar each.
/// Throws as check() does.
std::string table_svg(const FuzzyPicture& picture);

}  // namespace whisker::report
