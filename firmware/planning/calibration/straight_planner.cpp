#include "firmware/planning/calibration/straight_planner.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kRestForBias = 1500;  // ms: the bias of the gyro is measured meanwhile

}  // namespace

void StraightPlanner::start(const View& view) noexcept {
  phase_ = Phase::resting;
  leg_ = phase_ms_ = 0;
  turning_ = travel_ = 0;
  parts_ = {};
  way_ = Length{};
  course_ = view.pose.heading;
  begin();
}

void StraightPlanner::add(const View& view) noexcept {
  // Modulo a turn, because it also adds up while the body turns back, where nobody asks for it.
  turned_ = as_signed(static_cast<uint32_t>(turned_) + (view.pose.heading - heading_).raw());
  heading_ = view.pose.heading;
  difference_ += view.raw.counts.right - view.raw.counts.left;
  sum_ += view.raw.counts.right + view.raw.counts.left;
  if (phase_ == Phase::driving && sum_ - parts_.sum >= counts_of_way() / kPartsOfAWay) end_of_part();
}

/// Of both wheels.
int32_t StraightPlanner::counts_of_way() const noexcept {
  return multiply_divide(params_.wheels.counts_per_metre, length_.raw(), 500000);
}

/// The difference that would be right for the turn by the gyro, less that of the counts, 1/256 count.
int64_t StraightPlanner::turning(int32_t turned, int32_t difference) const noexcept {
  const int64_t circle = divide_rounded(int64_t{params_.body.track.raw()} * 6283185, 1000000);
  const int64_t per_turn = divide_rounded(circle * params_.wheels.counts_per_metre * 256, 1000000);
  return scale_down<32>(turned * per_turn) - int64_t{difference} * 256;
}

void StraightPlanner::end_of_part() noexcept {
  const int64_t error = turning(turned_ - parts_.turned, difference_ - parts_.difference);
  const int32_t skew = saturate32(divide_rounded(error * 39063, sum_ - parts_.sum));
  parts_.turned = turned_;
  parts_.difference = difference_;
  parts_.sum = sum_;
  parts_.total += skew;
  parts_.squares += static_cast<uint64_t>(square(skew));
  ++parts_.count;
}

void StraightPlanner::advance(const View& view) noexcept {
  phase_ms_ += view.elapsed.raw();
  add(view);
  switch (phase_) {
    case Phase::resting:
      if (!view.settled || phase_ms_ < kRestForBias) break;
      if (leg_ == 0) by_gyro_ = view.raw.by_gyro;
      if (legs_ > 1 && !by_gyro_) return end(Trouble::no_gyro);
      turned_ = difference_ = sum_ = 0;
      parts_.turned = parts_.difference = parts_.sum = 0;
      from_ = view.pose.at;
      drive_.begin(from_, course_, length_);
      drive_.step(view, decision_.manoeuvre);
      report(Mode::stepping, Why::none);
      follow(kArrows, phase_, Phase::driving);
      break;
    case Phase::driving:
      if (view.raw.by_gyro != by_gyro_) return end(Trouble::gyro_lost);
      switch (drive_.step(view, decision_.manoeuvre)) {
        case CourseDrive::Result::driving: break;
        case CourseDrive::Result::done: end_of_way(view); break;
        case CourseDrive::Result::blocked: end(Trouble::blocked); break;
      }
      break;
    case Phase::turning:
      if (!view.settled) break;
      follow(kArrows, phase_, Phase::resting);
      phase_ms_ = 0;
      break;
  }
}

void StraightPlanner::end_of_way(const View& view) noexcept {
  if (leg_ == 0) way_ = along(view.pose.at - from_, course_);
  if (sum_ <= 0) return end(Trouble::blocked);
  turning_ += turning(turned_, difference_);
  travel_ += int64_t{sum_} * 256;
  if (++leg_ == legs_) return legs_ > 1 ? conclude() : end(Trouble::none);
  course_ += 180_deg;
  decision_.manoeuvre = {ManoeuvreKind::turn, course_, {}, {}, {}};
  report(Mode::facing, Why::none);
  follow(kArrows, phase_, Phase::turning);
}

/// The gyro's random walk and bias and the counts' resolution say how much is off at least; the parts of the
/// ways differ by more if the floor turns the body.
void StraightPlanner::conclude() noexcept {
  const int64_t skew = divide_rounded_64(turning_ * 10000000, travel_);
  const int64_t ms = multiply_divide(length_.raw(), 1000, params_.wheels.max_speed.raw()) + 1000;
  const int64_t walk = params_.pose_error.gyro_walk.wrapped();  // 2^-32 turn after an hour
  const int64_t by_walk = quotient(walk * square_root(static_cast<uint64_t>(ms * 1000)), 60000);
  const int64_t by_bias = quotient(walk * ms, 84853);
  const uint32_t angle = square_root(static_cast<uint64_t>(by_walk * by_walk + by_bias * by_bias));
  // skew = angle track / (2 length); 2 pi / 2^32 rad
  const int64_t track_ppm = divide_rounded(int64_t{params_.body.track.raw()} * 1000000, length_.raw());
  const int64_t by_angle = scale_down<32>(angle * divide_rounded(track_ppm * 3141593, 100000));
  // Half a count at both ends.
  const int64_t by_counts = divide_rounded(5800000, counts_of_way());
  const int64_t of_way = by_angle * by_angle + by_counts * by_counts;
  // A part's counts are rounded as those of a way.
  const int32_t n = parts_.count;
  const int64_t rounding = square(by_counts * kPartsOfAWay);
  int64_t of_parts = 0;
  if (n > 2) {
    of_parts = static_cast<int64_t>(parts_.squares) - divide_rounded(parts_.total * parts_.total, n);
    of_parts = quotient(of_parts, n - 2) - rounding;
    of_parts = of_parts > 0 ? quotient(of_parts, n) : 0;
  }
  const int64_t sigma =
      square_root(static_cast<uint64_t>(quotient(of_way, legs_) + of_parts));  // of the skew, 1e-7
  // ratio = (1 + skew) / (1 - skew)
  const int64_t ratio = divide_rounded_64((10000000 + skew) * 1000000, 10000000 - skew);
  const Ratio of_ratio = Ratio::from_raw(saturate32(divide_rounded(sigma, 5)));
  if (of_ratio > kWorst) return end(Trouble::too_uncertain);
  values_[calibration::Quantity::wheel_ratio] = {saturate32(ratio), of_ratio};
  end(Trouble::none);
}

}  // namespace whisker::planning
