#pragma once

#include <optional>

#include "host/harness/worlds/generate.hpp"

namespace whisker::worlds {

/// The first of 1000 draws with the properties of the kind, without a name. The kind must have the options.
std::optional<Scenario> first_kept(Kind kind, const Options& options);
constexpr int kMostDraws = 1000;

}  // namespace whisker::worlds
