#pragma once

#include <cstring>

#include "firmware/fuzzy/bilinear.hpp"

namespace whisker::test {

inline bool same(const fuzzy::Bilinear::Table& a, const fuzzy::Bilinear::Table& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace whisker::test
