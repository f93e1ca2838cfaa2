/// Parts of the core that an image may leave out. The toolchain file of a chip without room for one sets its
/// variable to 0.
#pragma once

#ifndef WHISKER_EVASION
#define WHISKER_EVASION 1
#endif
#ifndef WHISKER_GYRO
#define WHISKER_GYRO 1
#endif
#ifndef WHISKER_INCIDENCE
#define WHISKER_INCIDENCE 1
#endif
#ifndef WHISKER_CALIBRATION
#define WHISKER_CALIBRATION 1
#endif
#ifndef WHISKER_NARROW_GAPS
#define WHISKER_NARROW_GAPS 1
#endif
#ifndef WHISKER_VOUCH
#define WHISKER_VOUCH 1
#endif

namespace whisker {

/// The planner leaves the path of what moves. Without, the robot stops before it, and stays.
constexpr bool kEvades = WHISKER_EVASION != 0;
/// A gyro and the bound of the pose (8 KB and 7 KB on an AVR).
constexpr bool kGyroBuilt = WHISKER_GYRO != 0;
/// The wheels' ratio, and what planners of a calibration need to know of a tick.
constexpr bool kCalibrationBuilt = WHISKER_CALIBRATION != 0;
/// The incidence that the sensors see, which is only reported (1.3 KB on an AVR).
constexpr bool kIncidenceBuilt = WHISKER_INCIDENCE != 0;
/// The robot passes gaps that are hardly wider than the body.
constexpr bool kNarrowGaps = WHISKER_NARROW_GAPS != 0;
/// The operator may say that ground is free, for whisker::Guard.
constexpr bool kVouches = WHISKER_VOUCH != 0;

/// A member that exists only if its part is built. Without the code for it, there is no room for it either,
/// and it must not be used.
template <class T, bool kBuilt>
class Part {
 public:
  Part() = default;
  template <class Argument>
  explicit Part(Argument& argument) noexcept : part_(argument) {}
  T* operator->() noexcept { return &part_; }
  const T* operator->() const noexcept { return &part_; }

 private:
  T part_;
};

template <class T>
class Part<T, false> {
 public:
  Part() = default;
  template <class Argument>
  explicit Part(Argument&) noexcept {}
  T* operator->() const noexcept { __builtin_unreachable(); }
};

}  // namespace whisker
