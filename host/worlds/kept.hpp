#pragma once

#include <optional>

#include "host/worlds/generate.hpp"

namespace whisker::worlds {

/// The first of 1000 draws that keeps the kind's promise, still without a name. The options must be such as
/// the kind takes.
std::optional<Scenario> first_kept(Kind kind, const Options& options);
constexpr int kMostDraws = 1000;

}  // namespace whisker::worlds
