#include "firmware/perception/repetition.hpp"

#include "firmware/math/quotient.hpp"

namespace whisker::perception {

using namespace literals;

namespace {

constexpr Length kLeft = 20_mm;
/// A body that leaves a circle by the tangent keeps its distance from the centre for a while: to 1 mm over
/// the root of 2 mm x radius.
constexpr int32_t kLeftPart = 8;  // of the radius, in addition

}  // namespace

bool Repetition::stuck(uint16_t mm, const Pose& body, Angle stuck_turn) noexcept {
  if (phase_ == Phase::over || mm != mm_) {
    phase_ = Phase::repeats;
    mm_ = mm;
    at_ = body.at;
    heading_ = body.heading;
  } else if (phase_ == Phase::repeats) {
    const Angle turn = body.heading - heading_;
    if (magnitude(turn) >= stuck_turn.raw()) suspect(body, turn);
  } else if (farther(body.at + polar(body.heading + heading_, radius_) - at_, kLeft + radius_ / kLeftPart)) {
    phase_ = Phase::stuck;
  }
  return phase_ == Phase::stuck;
}

void Repetition::suspect(const Pose& body, Angle turn) noexcept {
  phase_ = Phase::suspected;
  const Vec way = body.at - at_;
  const Angle half = scaled(turn, Q15::ratio(1, 2));
  const Angle centre = bearing(way) + half + (turn.wrapped() > 0 ? 90_deg : -90_deg);
  const uint64_t half_chord = static_cast<uint64_t>(norm(way).raw()) << 29;  // in the unit of the sine
  radius_ =
      Length::from_raw(saturate32(static_cast<int64_t>(quotient(half_chord, magnitude(sin(half).raw())))));
  at_ = body.at + polar(centre, radius_);
  heading_ = centre - body.heading;
}

}  // namespace whisker::perception
