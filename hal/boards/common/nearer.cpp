#include "hal/boards/common/nearer.hpp"

namespace whisker::hal::mcu {
namespace {

using hal::RangeStatus;

bool is_nearer(const hal::RangeReading& a, const hal::RangeReading& b) noexcept {
  if (a.status == RangeStatus::too_near) return b.status != RangeStatus::too_near;
  if (a.status != RangeStatus::ok) return false;
  return b.status == RangeStatus::clear || (b.status == RangeStatus::ok && a.mm < b.mm);
}

bool is_lost(const hal::RangeReading& r) noexcept {
  return r.status == RangeStatus::invalid || r.status == RangeStatus::stale;
}

}  // namespace

bool Nearer::read(hal::RangeReadings& out) noexcept {
  hal::RangeReadings second{};
  if (!leading_.read(out)) return false;
  if (!second_.read(second)) return true;
  for (int i = 0; i < hal::kBeams; ++i) {
    hal::RangeReading& beam = out.beam[i];
    if (is_lost(beam) || !is_nearer(second.beam[i], beam)) continue;
    beam.mm = second.beam[i].mm;
    beam.status = second.beam[i].status;
    beam.age_ms = second.beam[i].age_ms;
  }
  return true;
}

}  // namespace whisker::hal::mcu
