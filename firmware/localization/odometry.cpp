#include "firmware/localization/odometry.hpp"

namespace whisker::localization {
namespace {

/// The shorter difference between two values of the wrapping counter.
int32_t moved(uint32_t from, uint32_t to) noexcept {
  const uint32_t forward = (to - from) % hal::kEncoderModulus;
  const int32_t steps = static_cast<int32_t>(forward);
  return forward < hal::kEncoderModulus / 2 ? steps : steps - static_cast<int32_t>(hal::kEncoderModulus);
}

}  // namespace

void Odometry::configure(const Params& params) noexcept {
  um_per_count_ = divide_rounded(INT64_C(1000000) << 16, params.wheels.counts_per_metre);
  // Turn of the body per count, in radians: travel per count / track.
  constexpr int64_t kTurnPerRadianQ30 = 170891319;
  const int64_t radians_q36 = divide_rounded(um_per_count_ << 20, params.body.track.raw());
  turn_per_count_ = static_cast<uint64_t>(scale_down<18>(radians_q36 * kTurnPerRadianQ30));

  // The wheels turn by 1 -+ skew.
  const Ratio ratio = params.wheels.ratio;
  const Ratio one = millionths(1000000);
  const auto skewed = [&](int64_t x) { return divide_rounded(x * (ratio - one).raw(), (ratio + one).raw()); };
  skew_.share = narrow<int32_t>(skewed(INT64_C(1) << 24));
  skew_.um_per_count = skewed(um_per_count_);
  skew_.turn_per_count = skewed(static_cast<int64_t>(turn_per_count_));
  period_ = params.safety.period;
  const int32_t um_per_s = params.wheels.max_speed.raw() / 1000 * 512;
  counts_per_ms_ = narrow<uint32_t>(multiply_divide(um_per_s, params.wheels.counts_per_metre, 1000000));
}

void Odometry::place(const Pose& pose) noexcept {
  x_ = int64_t{pose.at.x.raw()} * 65536;
  y_ = int64_t{pose.at.y.raw()} * 65536;
  at_ = pose.at;
  start_heading_ = pose.heading;
  heading_ = pose.heading;
  difference_ = 0;
  skew_.sum = 0;
  has_last_ = false;
}

bool Odometry::update(const hal::EncoderCounts& counts, Duration since, CountStep& step) noexcept {
  if (!take(counts, since, step)) return false;
  advance(step);
  return true;
}

void Odometry::advance(const CountStep& step) noexcept {
  difference_ += step.right - step.left;
  const uint64_t turned = magnitude(difference_) * turn_per_count_;
  const Angle size = Angle::from_raw(static_cast<uint32_t>(turned >> 16));
  Angle now = start_heading_ + (difference_ < 0 ? -size : size);
  skew_.sum += step.right + step.left;
  const uint64_t skewed = static_cast<uint64_t>(skew_.sum) * static_cast<uint64_t>(skew_.turn_per_count);
  now += Angle::from_raw(static_cast<uint32_t>(skewed >> 16));
  advance(step, now - heading_);
}

bool Odometry::take(const hal::EncoderCounts& counts, Duration since, CountStep& step) noexcept {
  step = {};
  if (has_last_) step = {moved(last_.left, counts.left), moved(last_.right, counts.right)};
  last_ = counts;
  has_last_ = true;
  // The largest number of counts that fits into 32 bits.
  const Duration over = min(since + period_, milliseconds(2000));
  const uint32_t most = 2 + static_cast<uint32_t>(over.raw()) * counts_per_ms_ / 256;
  return magnitude(step.left) <= most && magnitude(step.right) <= most;
}

void Odometry::advance(const CountStep& step, Angle turn) noexcept {
  const Vec from = at_;
  const Angle middle = heading_ + scaled(turn, Q15::ratio(1, 2));
  heading_ += turn;
  int64_t both = (step.left + step.right) * um_per_count_;
  both += (step.right - step.left) * skew_.um_per_count;
  const int64_t distance_q10 = scale_down<7>(both);
  x_ += scale_down<24>(distance_q10 * cos(middle).raw());
  y_ += scale_down<24>(distance_q10 * sin(middle).raw());
  at_ = {Length::from_raw(saturate32(scale_down<16>(x_))), Length::from_raw(saturate32(scale_down<16>(y_)))};
  travelled_um_ += static_cast<uint32_t>(norm(at_ - from).raw());
}

int64_t Odometry::difference(const CountStep& step) const noexcept {
  const int64_t difference = int64_t{step.right - step.left} * 4096;
  return difference + scale_down<12>(signed_product(skew_.share, step.right + step.left));
}

Angle Odometry::turn_of(int64_t difference) const noexcept {
  // 2^-60 turn; it wraps after 16 turns, like an angle.
  const uint64_t turned = magnitude(difference) * turn_per_count_ + (UINT64_C(1) << 27);
  const Angle size = Angle::from_raw(static_cast<uint32_t>(turned >> 28));
  return difference < 0 ? -size : size;
}

int32_t Odometry::counts_per_turn() const noexcept {
  return saturate32(static_cast<int64_t>(quotient_64(UINT64_C(1) << 48, turn_per_count_)));
}

}  // namespace whisker::localization
