#include "firmware/can/mission.hpp"

namespace whisker::can {
namespace {

constexpr uint8_t kAllSeen = (1 << kMissionValues) - 1;

}  // namespace

MissionValues values_of(const Mission& m) noexcept {
  return {{static_cast<uint32_t>(m.start.at.x.raw()), static_cast<uint32_t>(m.start.at.y.raw()),
           m.start.heading.raw(), static_cast<uint32_t>(m.goal.at.x.raw()),
           static_cast<uint32_t>(m.goal.at.y.raw()), static_cast<uint32_t>(m.goal.tolerance.raw())}};
}

bool mission_of(const MissionValues& values, Mission& m) noexcept {
  constexpr int kHeading = 2;
  for (int i = 0; i < kMissionValues; ++i) {
    const Signal& s = MissionOrder::kMore[i];
    if (i != kHeading && (as_signed(values.of[i]) < s.min || as_signed(values.of[i]) > s.max)) return false;
  }
  const auto length = [&](int i) { return Length::from_raw(as_signed(values.of[i])); };
  m.start = {{length(0), length(1)}, Angle::from_raw(values.of[kHeading])};
  m.goal = {{length(3), length(4)}, length(5)};
  return true;
}

uint16_t digest_of(const MissionValues& values) noexcept {
  uint32_t hash = UINT32_C(0x811C9DC5);
  for (uint32_t value : values.of) {
    for (int i = 0; i < 4; ++i, value >>= 8) hash = (hash ^ (value & 0xFF)) * UINT32_C(0x01000193);
  }
  return static_cast<uint16_t>(hash ^ hash >> 16);
}

void MissionParts::on_frame(const MissionValue& part) noexcept {
  if (part.mission != mission_) seen_ = 0;
  mission_ = part.mission;
  const int i = static_cast<int>(part.part) - 1;
  values_.of[i] = part.value;
  seen_ = static_cast<uint8_t>(seen_ | 1 << i);
}

bool MissionParts::complete(const MissionOrder& order) const noexcept {
  return seen_ == kAllSeen && mission_ == order.mission && digest_of(values_) == order.digest;
}

}  // namespace whisker::can
