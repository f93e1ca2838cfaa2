/// A pose from outside, and what it does to the estimate.
#pragma once

#include "firmware/localization/pose_bound.hpp"
#include "firmware/math/trig.hpp"

namespace whisker::localization {

/// A pose and its standard deviations.
struct UncertainPose {
  Pose pose;
  PoseSigma sigma;
};

/// A fix is a jump if it differs from the estimate by more than this many standard deviations of the
/// difference: along the heading, across it, or in heading.
constexpr int32_t kJumpSigmas = 4;
bool jumps(const UncertainPose& estimate, const UncertainPose& fix) noexcept;

/// The mean of both, weighted by their variances along the heading, across it, and of the heading.
UncertainPose fused(const UncertainPose& estimate, const UncertainPose& fix) noexcept;

}  // namespace whisker::localization
