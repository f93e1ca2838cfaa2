/// A response table from a list of numbers.
#pragma once

#include <optional>
#include <vector>

#include "firmware/fuzzy/bilinear.hpp"

namespace whisker::play {

/// Turn and step of node after node, raw, R within D. None if the count is another, or a number is not an
/// answer that rules::response() gives: a whole number from -32767 to 32767.
std::optional<fuzzy::Bilinear::Table> table_of(const std::vector<double>& list);

}  // namespace whisker::play
