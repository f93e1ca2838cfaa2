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

/// At most PoseBound::kMost and a quarter turn. A negative one is no accuracy, and becomes the largest.
PoseSigma sound(const PoseSigma& sigma) noexcept;

/// By PoseBound::kJumpSigmas: along the heading, across it, or in heading.
bool jumps(const UncertainPose& estimate, const UncertainPose& fix) noexcept;

/// The mean of both, weighted by their variances along the heading, across it, and of the heading.
UncertainPose fused(const UncertainPose& estimate, const UncertainPose& fix) noexcept;

}  // namespace whisker::localization
