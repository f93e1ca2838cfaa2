#include "firmware/fuzzy/scale.hpp"

namespace whisker::fuzzy {
namespace {

constexpr int32_t kDistanceTop = 10 * Q7::kOne;
constexpr int32_t kBiasTop = 8 * Q7::kOne;

int64_t within(Length x, Length max_range) noexcept { return max(Length{}, min(x, max_range)).raw(); }

Q7 fraction_of(int32_t top, int64_t part, int32_t whole) noexcept {
  return Q7::from_raw(narrow<int16_t>(divide_rounded(top * part, whole)));
}

}  // namespace

Inputs scale(Length left, Length front, Length right, Length max_range) noexcept {
  const int32_t whole = max_range.raw();
  const int64_t l = within(left, max_range);
  const int64_t f = within(front, max_range);
  const int64_t r = within(right, max_range);
  const Q7 bias = r == l ? Q7{} : fraction_of(kBiasTop, r - l, whole);
  return {fraction_of(kDistanceTop, f, whole), bias};
}

}  // namespace whisker::fuzzy
