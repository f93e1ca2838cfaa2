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
#ifndef WHISKER_BUMPER
#define WHISKER_BUMPER 1
#endif
#ifndef WHISKER_MOTION_DETECTOR
#define WHISKER_MOTION_DETECTOR 1
#endif
#ifndef WHISKER_PARAM_CHECK
#define WHISKER_PARAM_CHECK 1
#endif
#ifndef WHISKER_POSE_HISTORY
#define WHISKER_POSE_HISTORY 16
#endif
#ifndef WHISKER_STATIC_SCANS
#define WHISKER_STATIC_SCANS 1
#endif
#ifndef WHISKER_SWEEPS
#define WHISKER_SWEEPS 1
#endif
#ifndef WHISKER_FRAMES
#define WHISKER_FRAMES 1
#endif
#ifndef WHISKER_NODS
#define WHISKER_NODS 1
#endif
#ifndef WHISKER_ASSIST
#define WHISKER_ASSIST 1
#endif
#ifndef WHISKER_WHEEL_WATCH
#define WHISKER_WHEEL_WATCH 1
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
/// Obstacles found by touch. Without, no bumper may be fitted.
constexpr bool kBumperBuilt = WHISKER_BUMPER != 0;
/// What moves is braked for. Without, only the static world is guarded, and readings are not judged by
/// contradictions.
constexpr bool kMotionDetectorBuilt = WHISKER_MOTION_DETECTOR != 0;
/// whisker::Guard checks its parameters at run time. Without, the program must: static_assert(check(params)
/// == ParamFault::none).
constexpr bool kParamCheckBuilt = WHISKER_PARAM_CHECK != 0;
/// Instants of the pose history: a smaller number interpolates over longer times, in proportion to the
/// latency.
constexpr int kPoseHistory = WHISKER_POSE_HISTORY;
/// Planners wait for scans of the standing body. whisker::Guard needs none.
constexpr bool kStaticScans = WHISKER_STATIC_SCANS != 0;
/// Readings one after another clear ground together, for sensors whose cones hold no cell at the rim.
/// Without, whisker::Guard refuses them; without kParamCheckBuilt, too, the program must:
/// static_assert(!rim_sweep(params).needed).
constexpr bool kSweeps = WHISKER_SWEEPS != 0;
/// A user's frame beside that of the odometry, for fixes from outside. Only whisker::Guard can be without.
constexpr bool kFrames = WHISKER_FRAMES != 0;
/// whisker::Guard turns a beam onto unseen ground.
constexpr bool kNodsBuilt = WHISKER_NODS != 0;
/// whisker::Guard bends and slows commands by the response table (9 KB on a Cortex-M3, with the table).
constexpr bool kAssistBuilt = WHISKER_ASSIST != 0;
/// A wheel that does not follow its command is a fault. Without, only a jump of the counts, and both wheels
/// held, are.
constexpr bool kWheelWatchBuilt = WHISKER_WHEEL_WATCH != 0;
/// The operator may say that ground is free, for whisker::Guard.
constexpr bool kVouches = WHISKER_VOUCH != 0;

/// A member that exists only if its part is built. Without the code for it, there is no room for it either,
/// and it must not be used.
template <class T, bool kBuilt>
class Part {
 public:
  [[gnu::always_inline]] constexpr Part() noexcept {}  // NOLINT(modernize-use-equals-default)
  template <class Argument>
  explicit Part(Argument& argument) noexcept : part_(argument) {}
  [[gnu::always_inline]] T* operator->() noexcept { return &part_; }
  [[gnu::always_inline]] const T* operator->() const noexcept { return &part_; }

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
