#include "firmware/perception/incidence_watch.hpp"

namespace whisker::perception {
namespace {

constexpr uint8_t kReadings = 5;
constexpr Length kOnTheSpot = 5_mm;
constexpr Angle kLeastTurn = Angle::turns(17, 3600);
constexpr Length kLeastSweep = 20_mm;
constexpr Length kStraight = 4_mm;
// The estimate rises and falls by these, which balance at 98 %.
constexpr Angle kRise = 2_deg;
constexpr Angle kFall = Angle::from_raw(kRise.raw() / 50);

}  // namespace

void IncidenceWatch::reset() noexcept {
  seen_ = {};
  count_ = measured_ = 0;
}

void IncidenceWatch::add(const Pose& from, const SeenRange (&seen)[hal::kBeams],
                         const Mount (&mounts)[hal::kBeams]) noexcept {
  if (count_ > 0 && farther(from.at - from_.at, kOnTheSpot)) count_ = 0;
  if (count_ == 0) from_ = from;
  ++count_;
  for (int i = 0; i < hal::kBeams; ++i) {
    const uint16_t mm = seen[i].mm;
    if (count_ == 1) {
      first_[i] = mm;
    } else if (mm == 0) {
      first_[i] = 0;
    } else if (count_ == (kReadings + 1) / 2) {
      middle_[i] = mm;
    } else if (count_ == kReadings && first_[i] != 0) {
      const Length grows = millimetres(mm) - millimetres(first_[i]);
      const Length middle = millimetres(middle_[i]);
      const Length bend = abs(millimetres(first_[i]) + grows / 2 - middle);
      const bool straight = bend <= kStraight + seen[i].scatter * 3 + abs(grows) / 8;
      if (straight)
        measure(middle + norm(mounts[i].apex), grows, from.heading - from_.heading, seen[i].scatter);
    }
  }
  if (count_ == kReadings) count_ = 0;
}

void IncidenceWatch::measure(Length distance, Length grows, Angle turned, Length scatter) noexcept {
  const Angle turn = Angle::from_raw(magnitude(turned));
  const Length sweep = arc(turn, distance);
  if (turn.raw() < kLeastTurn.raw() || sweep < max(kLeastSweep, scatter * 5)) return;
  const Angle incidence = bearing({sweep, abs(grows)});
  if (incidence.raw() > seen_.raw()) {
    seen_ += kRise;
  } else if (seen_.raw() > kFall.raw()) {
    seen_ = seen_ - kFall;
  }
  if (measured_ < kEnough) ++measured_;
}

}  // namespace whisker::perception
