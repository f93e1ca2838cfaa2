/// The size of the wheels from a drive along a tape measure.
#pragma once

#include "firmware/calibration/values.hpp"

namespace whisker::calibration {

/// A straight drive, as far as the robot believes to have gone and as far as the tape says.
struct Tape {
  static constexpr Length kShortest = 500_mm;
  static constexpr Length kSigma = 2_mm;  ///< how well a person reads a tape

  Length driven;
  Length measured;

  /// Both are kShortest to 100 m and differ by 20 % at most.
  bool plausible() const noexcept;
};

/// Counts per metre, and the track that goes with them. params: those of the drive. sigma: of the reading, 1
/// m at most; 1 mm is added for the axle at the zero of the tape. False: it is not plausible(); nothing is
/// changed.
bool take_tape(Values& values, const Params& params, const Tape& tape, Length sigma = Tape::kSigma) noexcept;

}  // namespace whisker::calibration
