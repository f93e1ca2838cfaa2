#include "firmware/perception/range_monitor.hpp"

namespace whisker::perception {
namespace {

constexpr Length kStep = 20_mm;
constexpr uint16_t kFading = 200;  // steps: 4 m
constexpr uint16_t kOne = RangeTrust::kOnePerMetre / 4;
static_assert(kStep * kFading == 4_m);

// Measured: docs/safety.md.
constexpr uint16_t kContradicted = 3 * RangeTrust::kOnePerMetre;
constexpr uint16_t kAbsurd = 8 * RangeTrust::kOnePerMetre;
// Where walls vanish at an angle, contradictions are part of the operation.
constexpr uint16_t kLossyContradicted = 20 * RangeTrust::kOnePerMetre;
constexpr uint16_t kLossyAbsurd = 70 * RangeTrust::kOnePerMetre;
constexpr uint16_t kManyPhantoms = 13107;
constexpr uint16_t kMostPhantoms = 42598;
constexpr uint16_t kSomeFalseClears = 6554;
constexpr uint16_t kMostFalseClears = 32768;

}  // namespace

void RangeMonitor::configure(const Params& params) noexcept {
  const bool lossy = loses_walls(params.rangefinders);
  doubtful_rate_ = lossy ? kLossyContradicted : kContradicted;
}

void RangeMonitor::reset() noexcept {
  incidence_.reset();
  trust_ = {};
  counted_ = 0;
}

void RangeMonitor::move_to(Vec at) noexcept {
  if (!farther(at - step_from_, kStep)) return;
  step_from_ = at;
  counted_ = 0;
  // Rounded up, so that a rate falls to zero.
  trust_.contradictions =
      narrow<uint16_t>(trust_.contradictions - (trust_.contradictions + kFading - 1) / kFading);
}

void RangeMonitor::contradict(bool approaches) noexcept {
  for (const uint8_t counts = approaches ? 2 : 1; counted_ < counts; ++counted_) {
    if (trust_.contradictions <= UINT16_MAX - kOne) {
      trust_.contradictions = narrow<uint16_t>(trust_.contradictions + kOne);
    }
  }
}

void RangeMonitor::judge(uint16_t phantoms, uint16_t false_clears) noexcept {
  trust_.phantoms = phantoms;
  trust_.false_clears = false_clears;
  trust_.incidence_deg = incidence_.seen_deg();
  // Phantoms appear in clear ground, and false clear readings clear ground wrongly.
  if (phantoms >= kManyPhantoms) trust_.contradictions = 0;
  const bool lossy = false_clears >= kSomeFalseClears || doubtful_rate_ == kLossyContradicted;
  const bool absurd = trust_.contradictions >= (lossy ? kLossyAbsurd : kAbsurd);
  if (absurd || phantoms >= kMostPhantoms || false_clears >= kMostFalseClears) {
    trust_.level = RangeLevel::untrusted;
  } else if (slows() || phantoms >= kManyPhantoms) {
    trust_.level = RangeLevel::doubtful;
  } else {
    trust_.level = RangeLevel::trusted;
  }
}

}  // namespace whisker::perception
