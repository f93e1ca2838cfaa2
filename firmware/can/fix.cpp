#include "firmware/can/fix.hpp"

namespace whisker::can {
namespace {

constexpr const Signal& kAlong = FixValue::kMore[2];
constexpr const Signal& kHeading = FixValue::kMore[4];

uint32_t limited(int32_t x, const Signal& signal) noexcept {
  const int64_t most = x < signal.max ? x : signal.max;
  return static_cast<uint32_t>(most < 0 ? 0 : most);
}

uint32_t most_of(FixPart part) noexcept {
  switch (part) {
    case FixPart::sigma_along:
    case FixPart::sigma_across: return static_cast<uint32_t>(kAlong.max);
    case FixPart::sigma_heading: return static_cast<uint32_t>(kHeading.max);
    case FixPart::x:
    case FixPart::y:
    case FixPart::heading: break;
  }
  return UINT32_MAX;
}

}  // namespace

FixValues values_of(const localization::UncertainPose& fix) noexcept {
  const localization::PoseSigma& sigma = fix.sigma;
  // Half a turn and more is negative.
  const int32_t heading = sigma.heading.wrapped() < 0 ? INT32_MAX : sigma.heading.wrapped();
  return {{static_cast<uint32_t>(fix.pose.at.x.raw()), static_cast<uint32_t>(fix.pose.at.y.raw()),
           fix.pose.heading.raw(), limited(sigma.along.raw(), kAlong), limited(sigma.across.raw(), kAlong),
           limited(heading, kHeading)}};
}

bool FixParts::on_frame(const FixValue& part) noexcept {
  if (part.value > most_of(part.part)) return false;
  if (part.tick != tick_) seen_ = 0;
  tick_ = part.tick;
  const auto i = static_cast<uint8_t>(part.part);
  values_.of[i] = part.value;
  seen_ = static_cast<uint8_t>(seen_ | 1 << i);
  return true;
}

localization::UncertainPose FixParts::fix() const noexcept {
  const auto length = [&](int i) { return Length::from_raw(as_signed(values_.of[i])); };
  return {{{length(0), length(1)}, Angle::from_raw(values_.of[2])},
          {length(3), length(4), Angle::from_raw(values_.of[5])}};
}

}  // namespace whisker::can
