#include "firmware/perception/contacts.hpp"

#include "firmware/params.hpp"
#include "hal/types.hpp"

namespace whisker::perception {
namespace {

// The middle of the sector that a side switch covers, if the front one covers 30 degrees to each side.
constexpr Angle kBeside = 60_deg;
constexpr Angle kBetween = 30_deg;

Angle direction(uint8_t pressed) noexcept {
  const int32_t side = (pressed >> hal::kLeft & 1) - (pressed >> hal::kRight & 1);
  return ((pressed >> hal::kFront & 1) != 0 ? kBetween : kBeside) * side;
}

}  // namespace

void Contacts::add(uint8_t pressed, const Pose& body) noexcept {
  // The disc touches the rim of the body from outside.
  const Vec place = body.at + polar(body.heading + direction(pressed), radius_ * 4);
  for (int i = 0; i < count_; ++i) {
    if (!farther(place - places_[i], radius_ / 2)) return;
  }
  places_[next_] = place;
  next_ = static_cast<int8_t>((next_ + 1) % kKept);
  if (count_ < kKept) ++count_;
}

}  // namespace whisker::perception
