#include "firmware/calibration/tape.hpp"

#include "firmware/math/trig.hpp"

namespace whisker::calibration {
namespace {

constexpr Length kLongest = 100000_mm;
constexpr int64_t kStartUm = 1000;  // of the axle at the zero of the tape

}  // namespace

bool Tape::plausible() const noexcept {
  const Length shorter = min(driven, measured), longer = max(driven, measured);
  return shorter >= kShortest && longer <= kLongest && longer - shorter <= measured / 5;
}

bool take_tape(Values& values, const Params& params, const Tape& tape, Length sigma) noexcept {
  if (!tape.plausible()) return false;
  const int32_t counts =
      multiply_divide(params.wheels.counts_per_metre, tape.driven.raw(), tape.measured.raw());
  if (counts <= 0) return false;
  // In nm, and then 1e-9 of the way.
  const int64_t squared_um = square(sigma.raw()) + square(kStartUm);
  const int64_t reading_nm = square_root(static_cast<uint64_t>(squared_um * 1000000));
  const int64_t reading = divide_rounded(reading_nm * 1000000, tape.measured.raw());
  // The counts are whole: half of one, evenly distributed.
  const int64_t rounding = divide_rounded(288675135, counts);
  const int64_t both = square_root(static_cast<uint64_t>(square(reading) + square(rounding)));
  rescale(values, params, {counts, Ratio::from_raw(saturate32(divide_rounded(both, 1000)))});
  return true;
}

}  // namespace whisker::calibration
