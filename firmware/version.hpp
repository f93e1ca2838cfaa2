/// The version of Whisker, by the rules of semver.org. This is its only place: CMake reads these lines.
#pragma once

#include <stdint.h>

#define WHISKER_VERSION_MAJOR 0
#define WHISKER_VERSION_MINOR 2
#define WHISKER_VERSION_PATCH 0

/// major << 16 | minor << 8 | patch: for comparisons, also by the preprocessor.
#define WHISKER_VERSION_NUMBER \
  (WHISKER_VERSION_MAJOR * 65536 + WHISKER_VERSION_MINOR * 256 + WHISKER_VERSION_PATCH)

namespace whisker {

constexpr uint32_t kVersionNumber = WHISKER_VERSION_NUMBER;
static_assert(WHISKER_VERSION_MAJOR < 256 && WHISKER_VERSION_MINOR < 256 && WHISKER_VERSION_PATCH < 256);

}  // namespace whisker
