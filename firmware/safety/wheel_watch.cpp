#include "firmware/safety/wheel_watch.hpp"

namespace whisker::safety {
namespace {

constexpr Length kStretch = 40_mm;  // for the reference body
constexpr int32_t kCounts = 10;     // fewer counts do not allow a judgement of fractions
constexpr int kHeldShift = 6;
constexpr int32_t kHeldStretches = 15;
constexpr Length kMostHeld = Length::from_raw(INT32_C(65535) << kHeldShift);

}  // namespace

void WheelWatch::configure(const Params& params) noexcept {
  um_per_count_ = divide_rounded(1000000, params.wheels.counts_per_metre);
  // A command and its effect are up to one gap apart, or the lag that a wheel does not have; twice that, from
  // full speed to the other direction.
  const Length gap = params.wheels.max_speed * (longest_gap(params) * 2);
  const Length lag = params.wheels.max_speed * (params.wheels.motor_lag * 2);
  stretch_ = max(max(for_body(params, kStretch), way(kCounts)), max(gap, lag));
  ahead_ = gap + lag;
}

int32_t WheelWatch::steady(Wheel& wheel, int32_t counts) noexcept {
  const int32_t at = wheel.slack + counts;
  wheel.slack = static_cast<int16_t>(at > 1 ? 1 : at < -1 ? -1 : at);
  return at - wheel.slack;
}

void WheelWatch::expect(WheelPair speeds, Duration elapsed) noexcept {
  const Length way[2] = {speeds.left * elapsed, speeds.right * elapsed};
  for (int i = 0; i < 2; ++i) {
    wheel_[i].expected += abs(way[i]);
    wheel_[i].commanded_way += way[i];
  }
}

WheelWatch::Finding WheelWatch::judge(Wheel& wheel) const noexcept {
  if (max(wheel.expected, wheel.counted) < stretch_) return Finding::none;
  const Length apart = abs(wheel.commanded_way - wheel.counted_way);
  if (wheel.counted < wheel.expected / 4 && apart > stretch_ / 4) {
    if (wheel.other >= stretch_ / 2) return Finding::stalled;
    if (wheel.other > Length{}) {
      // The other one holds the heading of a body that does not move, and hardly turns.
      const Length beyond = max(abs(wheel.commanded_way) - stretch_, Length{});
      const Length held = min(Length::from_raw(wheel.held << kHeldShift) + beyond, kMostHeld);
      if (held >= min(stretch_ * kHeldStretches, kMostHeld)) return Finding::stalled;
      wheel.held = narrow<uint16_t>(held.raw() >> kHeldShift);
    }
    // Something holds both wheels, which has a separate time-out. The motion missed meanwhile must not count
    // after release.
    wheel.expected = min(wheel.expected, stretch_);
    wheel.commanded_way = limit(wheel.commanded_way, stretch_);
    return Finding::none;
  }
  if (wheel.counted / 3 > wheel.expected || apart > (wheel.expected + wheel.counted) * 3 / 4) {
    if (max(wheel.expected, wheel.counted) < ahead_) return Finding::none;
    // A wheel with less lag than stated swings farther to and fro, but not away.
    if (apart > ahead_ / 2) return Finding::runaway;
  }
  const int16_t slack = wheel.slack;
  wheel = {};
  wheel.slack = slack;
  return Finding::none;
}

WheelWatch::Finding WheelWatch::judge(const localization::CountStep& counts) noexcept {
  const int32_t step[2] = {counts.left, counts.right};
  for (int i = 0; i < 2; ++i) {
    const Length turned = abs(way(steady(wheel_[i], step[i])));
    wheel_[i].counted += turned;
    wheel_[i].counted_way += way(step[i]);
    wheel_[1 - i].other += turned;
  }
  const Finding finding = judge(wheel_[0]);
  return finding != Finding::none ? finding : judge(wheel_[1]);
}

}  // namespace whisker::safety
