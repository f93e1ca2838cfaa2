#include "firmware/can/heard.hpp"

namespace whisker::can {
namespace {

constexpr uint32_t kStands_ms = 100;

}  // namespace

void Heard::wheels(const WheelState& state, uint32_t now) noexcept {
  if (state.valid == 0) return;
  wheels_ = now;
  if (state.counts.left == counts_.left && state.counts.right == counts_.right) return;
  turned_ = counted_;
  counted_ = true;
  counts_ = state.counts;
  turned_at_ = now;
}

void Heard::begin(uint32_t now) noexcept {
  for (uint32_t& seen : beams_) seen = now;
  wheels_ = set_ = now;
}

/// Some beam.
bool Heard::silent(uint32_t longest, uint32_t now) const noexcept {
  for (const uint32_t seen : beams_) {
    if (now - seen > longest) return true;
  }
  return false;
}

bool Heard::stands(uint32_t now) const noexcept { return !turned_ || now - turned_at_ >= kStands_ms; }

}  // namespace whisker::can
