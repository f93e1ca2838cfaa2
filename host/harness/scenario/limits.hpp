/// Limits of the numbers and shapes of a scenario from any source: a file, or the playground.
#pragma once

#include <cstddef>
#include <vector>

#include "host/harness/scenario/scenario.hpp"

namespace whisker {

/// Range of a number.
struct Limits {
  double low;
  double high;
  bool low_excluded = false;

  /// Not-a-number is in no range.
  bool allow(double x) const { return x <= high && (low_excluded ? x > low : x >= low); }
};

constexpr double kFarthest = 1000;  ///< m; no coordinate or length of a scenario exceeds it
constexpr Limits kCoordinate{-kFarthest, kFarthest};
constexpr Limits kLength{0, kFarthest, true};
constexpr Limits kProbability{0, 1};
constexpr Limits kTimeLimit{0, 1e6, true};    // s
constexpr Limits kEventTime{0, 1e6};          // s
constexpr Limits kMoverSpeed{0, 10};          // m/s
constexpr Limits kRangeSigma{0, 10};          // m
constexpr Limits kWheelScaleSigma{0, 1};      //
constexpr Limits kHeadingDrift{0, 360};       // deg/m^0.5
constexpr Limits kWheelSlip{0, 0.5};          //
constexpr Limits kGyroBias{0, 100};           // deg/s
constexpr Limits kGyroWalk{0, 100};           // deg/h^0.5
constexpr Limits kGyroScaleSigma{0, 0.2};     //
constexpr Limits kFixEvery{0, kFarthest};     // m
constexpr Limits kFixSigma{0, 10};            // m
constexpr Limits kFixTurnSigma{0, 90};        // deg
constexpr Limits kIncidence{5, 90};           // deg
constexpr Limits kTrueCone{0.5, 170};         // deg
constexpr Limits kTrueMinRange{0, 10};        // m
constexpr Limits kTrueMaxRange{0, 60, true};  // m
constexpr Limits kTrueLength{0, kFarthest};   // m
constexpr Limits kCoverGlass{0, 1};           // m
constexpr Limits kAmbient{0, 200};            // klux
constexpr Limits kSkew{-45, 45};              // deg
constexpr Limits kRangeScale{0.5, 2};         //
constexpr std::size_t kMostPoints = 4096;     ///< of one list
constexpr std::size_t kFewestOfPolygon = 3;
constexpr std::size_t kFewestOfLine = 2;

bool is_sound(const Bounds& bounds);
bool is_within(sim::Vec2 p, const Bounds& bounds);
/// No point is the same as the one before it.
bool all_differ(const std::vector<sim::Vec2>& points);
bool has_area(const std::vector<sim::Vec2>& polygon);
/// Distance of the mover from its path, m, and whether it is more than the error of a coordinate rounded by
/// hand.
double off_path(const Mover& mover);
bool is_on_path(const Mover& mover);

}  // namespace whisker
