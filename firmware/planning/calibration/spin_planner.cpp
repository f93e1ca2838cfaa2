#include "firmware/planning/calibration/spin_planner.hpp"

#include "firmware/planning/steering.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kRestBefore = 500;          // ms
constexpr int32_t kLongestHold = 3000;        // ms
constexpr int64_t kRunUp = INT64_C(1) << 28;  // 2^-32 turn
constexpr int32_t kBetween = RangeProfile::kTurn * (SpinPlanner::kTurns - 1);
constexpr int32_t kEnd = kBetween + RangeProfile::kTurn + ProfileMatch::kWindow;
constexpr int32_t kReadingsPerTurn = 180;
constexpr int kStepsPerTick = 2;
constexpr Length kMoved = 40_mm;
constexpr uint8_t kTooOld = 255;

int32_t most_millimetres(const Params& params) noexcept { return params.rangefinders.max_range.raw() / 1000; }

uint16_t millimetres_of(const hal::RangeReading& reading, const Params& params) noexcept {
  const int32_t most = most_millimetres(params);
  if (reading.status == hal::RangeStatus::clear) return static_cast<uint16_t>(most);
  if (reading.status == hal::RangeStatus::too_near) {
    return static_cast<uint16_t>(params.rangefinders.min_range.raw() / 1000);
  }
  return reading.mm < most ? reading.mm : static_cast<uint16_t>(most);
}

bool says(const hal::RangeReading& reading) noexcept {
  return reading.status == hal::RangeStatus::ok || reading.status == hal::RangeStatus::clear ||
         reading.status == hal::RangeStatus::too_near;
}

}  // namespace

AngularRate SpinPlanner::rate() const noexcept {
  const int32_t by_readings = params_.rangefinders.rate_hz * 6283185 / kReadingsPerTurn;
  const AngularRate most = min(turn_rate(params_), AngularRate::from_raw(1500000));
  const AngularRate by_gyro = params_.gyro.range / 2;
  const AngularRate rate = min(most, AngularRate::from_raw(by_readings));
  return params_.gyro.fitted == Fitted::yes ? min(rate, by_gyro) : rate;
}

void SpinPlanner::start(const View& view) noexcept {
  first_.clear();
  last_.clear();
  phase_ = Phase::resting;
  place_ = view.pose.at;
  heading_ = view.pose.heading;
  turned_ = 0;
  counts_ = pasts_ = ms_ = phase_ms_ = held_ms_ = spun_ms_ = 0;
  begin();
}

void SpinPlanner::advance(const View& view) noexcept {
  ms_ += view.elapsed.raw();
  phase_ms_ += view.elapsed.raw();
  const Angle step = view.pose.heading - heading_;
  heading_ = view.pose.heading;
  switch (phase_) {
    case Phase::resting:
      if (!view.settled || phase_ms_ < kRestBefore) break;
      by_gyro_ = view.raw.by_gyro;
      decision_.manoeuvre = cruise({{}, rate()}, params_);
      report(Mode::surveying, Why::none);
      planning::follow(kArrows, phase_, Phase::running_up);
      break;
    case Phase::running_up:
      turned_ += step.wrapped();
      watch(view);
      if (turned_ < kRunUp || trouble() != Trouble::not_finished) break;
      turned_ = 0;
      planning::follow(kArrows, phase_, Phase::spinning);
      phase_ms_ = 0;
      for (int i = 0; i < hal::kBeams; ++i) sequence_[i] = view.raw.ranges.beam[i].sequence;
      break;
    case Phase::spinning:
      turned_ += step.wrapped();
      counts_ += view.raw.counts.right - view.raw.counts.left;
      follow(view);
      watch(view);
      break;
    case Phase::stopping:
      if (!view.settled) break;
      match_.start();
      planning::follow(kArrows, phase_, Phase::matching);
      break;
    case Phase::matching:
      for (int i = 0; i < kStepsPerTick; ++i) {
        if (match_.step()) continue;
        conclude();
        break;
      }
      if (phase_ == Phase::matching) decision_.manoeuvre = stop();
      break;
  }
}

void SpinPlanner::follow(const View& view) noexcept {
  const int32_t heading = static_cast<int32_t>(scale_down<24>(turned_ * RangeProfile::kTurn));
  past_[pasts_ % kPasts] = {ms_, heading};
  ++pasts_;
  sample(view.raw.ranges);
  if (heading < kEnd * 256) return;
  spun_ms_ = phase_ms_;
  decision_.manoeuvre = stop();
  report(Mode::looking, Why::none);
  planning::follow(kArrows, phase_, Phase::stopping);
}

bool SpinPlanner::heading_at(int32_t ms, int32_t& heading) const noexcept {
  const int32_t kept = pasts_ < kPasts ? pasts_ : kPasts;
  for (int32_t i = 1; i < kept; ++i) {
    const Past& before = past_[(pasts_ - 1 - i) % kPasts];
    if (before.ms > ms) continue;
    const Past& after = past_[(pasts_ - i) % kPasts];
    heading = before.heading +
              multiply_divide(after.heading - before.heading, ms - before.ms, after.ms - before.ms);
    return true;
  }
  return false;
}

void SpinPlanner::sample(const hal::RangeReadings& ranges) noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    const hal::RangeReading& reading = ranges.beam[i];
    if (reading.sequence == sequence_[i] || reading.status == hal::RangeStatus::stale) continue;
    sequence_[i] = reading.sequence;
    int32_t heading = 0;
    if (reading.age_ms == kTooOld || !says(reading) || !heading_at(ms_ - reading.age_ms, heading)) continue;
    const int32_t at = static_cast<int32_t>(divide_rounded(heading, 256));
    const uint16_t mm = millimetres_of(reading, params_);
    const bool echo = reading.status == hal::RangeStatus::ok && mm < most_millimetres(params_);
    if (at <= RangeProfile::kTurn + 2 * ProfileMatch::kWindow) first_.add(i, at, mm, echo);
    const int32_t later = at - kBetween;
    if (later >= ProfileMatch::kWindow) last_.add(i, later, mm, echo);
  }
}

void SpinPlanner::watch(const View& view) noexcept {
  if (trouble() != Trouble::not_finished || phase_ > Phase::spinning) return;
  const bool moves = view.raw.counts.left != 0 || view.raw.counts.right != 0;
  held_ms_ = moves ? 0 : held_ms_ + view.elapsed.raw();
  // Of the whole spin, in ms: turns of 2 pi rad.
  const int32_t expected = multiply_divide((kTurns + 1) * 6283185, 1000, rate().raw());
  if (view.raw.by_gyro != by_gyro_)
    end(Trouble::gyro_lost);
  else if (held_ms_ > kLongestHold)
    end(Trouble::blocked);
  else if (phase_ms_ > 2 * expected + kRestBefore + kLongestHold)
    end(Trouble::too_slow);
  else if (farther(view.pose.at - place_, kMoved))
    end(Trouble::body_moved);
}

/// Of the angle by the gyro over this time: its random walk, and the bias measured in two seconds. By the
/// wheels: their resolution.
Ratio SpinPlanner::heading_sigma(Duration over) const noexcept {
  // A third of a count: its rounding does not average out if the counts between two readings are whole.
  if (!by_gyro_) return Ratio::from_raw(static_cast<int32_t>(500000 / (magnitude(counts_) + 1)));
  // An hour is 3600 s: in 2^-32 turn, the walk over t is walk sqrt(t / 3600), the bias' error t walk
  // sqrt(1 / 7200).
  const uint64_t walk = magnitude(params_.pose_error.gyro_walk);
  const uint64_t ms = static_cast<uint64_t>(over.raw());
  const uint64_t by_walk = quotient(walk * square_root(ms * 1000), 60000U);
  const uint64_t by_bias = quotient(walk * ms, 84853U);
  const uint64_t sum = square_root(by_walk * by_walk + by_bias * by_bias);
  return Ratio::from_raw(static_cast<int32_t>(quotient(sum * 1000000, uint32_t{kTurns} - 1) >> 32));
}

void SpinPlanner::conclude() noexcept {
  using calibration::Quantity;
  if (match_.trouble() != Trouble::none) return end(match_.trouble());
  // Of whole turns, and what gyro or wheels say; 1/256 unit.
  constexpr int32_t kTrue = kBetween * 256;
  const int32_t believed = kTrue + match_.offset();
  const Ratio match_sigma = Ratio::from_raw(multiply_divide(match_.sigma(), 1000000, kTrue));
  const Ratio by_heading = heading_sigma(Duration::from_raw(spun_ms_ * (kTurns - 1) / kTurns));
  const auto both = [](Ratio a, Ratio b) {
    return Ratio::from_raw(static_cast<int32_t>(
        square_root(static_cast<uint64_t>(square(a.raw())) + static_cast<uint64_t>(square(b.raw())))));
  };
  const Ratio sigma = both(match_sigma, by_heading);
  if (sigma > kWorst) return end(Trouble::too_uncertain);
  if (by_gyro_) {
    values_[Quantity::gyro_scale] = {multiply_divide(params_.gyro.scale.raw(), kTrue, believed), sigma};
  }
  // Track = difference of the rims / true turn. The rims in 2^-4 um, the turn in 2^-20.
  const int64_t rims = divide_rounded(int64_t{counts_} * 16000000, params_.wheels.counts_per_metre);
  const int64_t turned = scale_down<12>(turned_);
  const int64_t radians = scale_down<17>(turned * 823550);
  const int32_t track = saturate32(divide_rounded_64(rims * 65536, radians));
  const Ratio of_counts = Ratio::from_raw(static_cast<int32_t>(1000000 / (magnitude(counts_) + 1)));
  values_[Quantity::track] = {multiply_divide(track, believed, kTrue), both(sigma, of_counts)};
  end(Trouble::none);
}

}  // namespace whisker::planning
