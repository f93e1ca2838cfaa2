#include "host/harness/bus/fault_injector.hpp"

#include <utility>

namespace whisker::bus {
namespace {

bool towards(const Fault& fault, Direction direction) noexcept {
  return fault.direction == Direction::both || fault.direction == direction;
}

}  // namespace

FaultInjector::FaultInjector(Schedule schedule, std::uint64_t seed, Repair repair)
    : schedule_(std::move(schedule)), memory_(schedule_.size()), random_(seed), repair_(std::move(repair)) {
  at_tick(0);
}

bool FaultInjector::in_time(const Fault& fault) const noexcept {
  return tick_ >= fault.from_tick && tick_ < fault.to_tick;
}

void FaultInjector::at_tick(std::uint32_t tick) {
  tick_ = tick;
  for (std::size_t i = 0; i < schedule_.size(); ++i) {
    const Fault& fault = schedule_[i];
    if (!of_port(fault.kind)) continue;
    memory_[i].holds = in_time(fault) && (fault.chance >= 1 || random_.chance(fault.chance));
  }
}

const Fault* FaultInjector::active(FaultKind kind, Direction direction) const noexcept {
  for (std::size_t i = 0; i < schedule_.size(); ++i) {
    if (schedule_[i].kind == kind && memory_[i].holds && towards(schedule_[i], direction))
      return &schedule_[i];
  }
  return nullptr;
}

bool FaultInjector::hits(const Fault& fault, Memory& memory, const hal::CanFrame& frame,
                         Direction direction) {
  if (!in_time(fault) || !towards(fault, direction)) return false;
  if ((frame.id & fault.match_mask) != (fault.match_id & fault.match_mask)) return false;
  if (memory.burst_left > 0) {
    --memory.burst_left;
    return true;
  }
  if (fault.chance < 1 && !random_.chance(fault.chance)) return false;
  if (fault.kind == FaultKind::loss && fault.length > 1) memory.burst_left = fault.length - 1;
  return true;
}

void FaultInjector::flip_bit(hal::CanFrame& frame) {
  const int bit = random_.index(8 * frame.size);
  frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ (1U << (bit % 8)));
}

/// False if there is nothing to change.
bool FaultInjector::change(const Fault& fault, Memory& memory, Outcome& outcome) {
  hal::CanFrame& frame = outcome.frame;
  const bool has_data = frame.size > 0 && !frame.remote;
  switch (fault.kind) {
    case FaultKind::loss: outcome.copies = 0; return true;
    case FaultKind::delay:
      outcome.ticks += fault.ticks;
      if (fault.jitter > 0)
        outcome.ticks += static_cast<std::uint32_t>(random_.bits() % (fault.jitter + 1ULL));
      return true;
    case FaultKind::duplicate: ++outcome.copies; return true;
    case FaultKind::reorder: outcome.held = true; return true;
    case FaultKind::corrupt:
    case FaultKind::forge:
      if (!has_data) return false;
      flip_bit(frame);
      if (fault.kind == FaultKind::forge && repair_) repair_(frame);
      return true;
    case FaultKind::freeze: {
      const auto [first, is_new] = memory.frozen.emplace(frame.id, frame);
      frame = first->second;
      return !is_new;
    }
    case FaultKind::wrong_size:
      frame.size = static_cast<std::uint8_t>((frame.size + 1 + random_.index(8)) % 9);
      return true;
    case FaultKind::make_remote: frame.remote = true; return true;
    case FaultKind::make_extended: frame.extended = true; return true;
    case FaultKind::masquerade:
      frame.id = fault.id;
      frame.extended = fault.id > 0x7FF;
      return true;
    default: return false;
  }
}

FaultInjector::Outcome FaultInjector::meddle(const hal::CanFrame& frame, Direction direction) {
  Outcome outcome{frame, 1, 0, false};
  for (std::size_t i = 0; i < schedule_.size() && outcome.copies > 0; ++i) {
    const Fault& fault = schedule_[i];
    if (of_port(fault.kind) || !hits(fault, memory_[i], outcome.frame, direction)) continue;
    if (change(fault, memory_[i], outcome)) ++of(tally, fault.kind);
  }
  return outcome;
}

hal::CanFrame FaultInjector::babble(const Fault& fault) {
  ++of(tally, FaultKind::babble);
  hal::CanFrame frame{fault.id, fault.id > 0x7FF, false, 8, {}};
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_.bits());
  return frame;
}

}  // namespace whisker::bus
