#include "host/harness/bus/fault_port.hpp"

#include <algorithm>
#include <utility>

#include "host/harness/bus/memory_bus.hpp"

namespace whisker::bus {
namespace {

using hal::CanFrame;
using hal::CanState;

bool takes_part(CanState state) noexcept { return state == CanState::active || state == CanState::passive; }

}  // namespace

FaultPort::FaultPort(hal::CanPort& inner, Schedule schedule, std::uint64_t seed, Repair repair)
    : inner_(inner), injector_(std::move(schedule), seed, std::move(repair)), inner_counts_(inner.counts()) {}

const Fault* FaultPort::active(FaultKind kind) const noexcept {
  const Fault* fault = injector_.active(kind, Direction::in);
  return fault != nullptr ? fault : injector_.active(kind, Direction::out);
}

CanState FaultPort::state() const noexcept {
  if (is_off_) return CanState::bus_off;
  if (is_down_ || is_restarting_) return CanState::starting;
  const CanState inner = inner_.state();
  return takes_part(inner) && active(FaultKind::passive) != nullptr ? CanState::passive : inner;
}

bool FaultPort::on_bus() const noexcept { return takes_part(state()); }

void FaultPort::at_tick(std::uint32_t tick) {
  injector_.at_tick(tick);
  received_in_tick_ = 0;
  if (active(FaultKind::passive) != nullptr) ++of(injector_.tally, FaultKind::passive);
  release_late(out_);
  release_late(in_);
  if (const Fault* babble = injector_.active(FaultKind::babble, Direction::in); babble != nullptr) {
    for (std::uint32_t i = 0; i < babble->length; ++i)
      in_.ready.push_back({injector_.babble(*babble), 0, tick});
  }
  const Fault* babble = injector_.active(FaultKind::babble, Direction::out);
  if (babble == nullptr || babble->direction != Direction::out) return;
  for (std::uint32_t i = 0; i < babble->length; ++i) {
    out_.ready.push_back({injector_.babble(*babble), kLongestLife, tick});
  }
}

void FaultPort::release_late(Way& way) {
  const auto due = [this](const Passing& p) { return p.due_tick <= injector_.tick(); };
  std::copy_if(way.late.begin(), way.late.end(), std::back_inserter(way.ready), due);
  way.late.erase(std::remove_if(way.late.begin(), way.late.end(), due), way.late.end());
}

void FaultPort::pass(Way& way, const CanFrame& frame, std::uint8_t lifetime_ms, Direction direction) {
  const FaultInjector::Outcome outcome = injector_.meddle(frame, direction);
  const Passing passing{outcome.frame, lifetime_ms, injector_.tick() + outcome.ticks};
  // At most one frame is held, because two held frames would wait for each other forever.
  const bool hold = outcome.held && way.held.empty();
  std::deque<Passing>& to = hold ? way.held : outcome.ticks > 0 ? way.late : way.ready;
  for (std::uint32_t i = 0; i < outcome.copies; ++i) to.push_back(passing);
  if (hold || outcome.copies == 0) return;
  std::move(way.held.begin(), way.held.end(), std::back_inserter(way.ready));
  way.held.clear();
}

void FaultPort::see_state() {
  is_restarting_ = false;
  const bool goes_off = active(FaultKind::bus_off) != nullptr && !is_off_;
  const bool goes_down = active(FaultKind::down) != nullptr && !is_down_;
  is_down_ = active(FaultKind::down) != nullptr;
  if (goes_off) {
    is_off_ = true;
    hal::count(counts_.bus_offs);
    ++of(injector_.tally, FaultKind::bus_off);
  }
  if (goes_down) ++of(injector_.tally, FaultKind::down);
  if (goes_off || goes_down) outbox_.drop_all(counts_);
}

void FaultPort::see_incoming() {
  const Fault* overrun = injector_.active(FaultKind::overrun, Direction::in);
  for (CanFrame frame{}; inner_.receive(frame);) {
    if (!on_bus()) continue;
    if (overrun != nullptr && ++received_in_tick_ > overrun->length) {
      hal::count(counts_.overrun);
      ++of(injector_.tally, FaultKind::overrun);
      continue;
    }
    pass(in_, frame, 0, Direction::in);
  }
  for (const Passing& passing : in_.ready) {
    if (on_bus()) inbox_.push(passing.frame, counts_);
  }
  in_.ready.clear();
}

bool FaultPort::outbid(const CanFrame& frame) const noexcept {
  const Fault* babble = injector_.active(FaultKind::babble, Direction::in);
  if (babble == nullptr) return false;
  return arbitration({babble->id, babble->id > 0x7FF, false, 8, {}}) < arbitration(frame);
}

void FaultPort::see_outgoing(std::uint32_t now_ms) {
  const hal::CanOutbox::Waiting* next = outbox_.first();
  const bool is_outbid = next != nullptr && outbid(next->frame);
  const bool is_full = injector_.active(FaultKind::full, Direction::out) != nullptr;
  const std::uint8_t expired = outbox_.expire(now_ms, counts_);
  if (is_outbid) hal::count(counts_.outbid, expired);
  if (is_full) of(injector_.tally, FaultKind::full) += expired;
  if (!on_bus() || is_full) return;
  for (next = outbox_.first(); next != nullptr && !outbid(next->frame); next = outbox_.first()) {
    const auto left_ms = static_cast<std::uint8_t>(next->until_ms - now_ms);
    pass(out_, next->frame, left_ms, Direction::out);
    outbox_.pop();
    hal::count(counts_.sent);
  }
  for (const Passing& passing : out_.ready) inner_.send(passing.frame, passing.lifetime_ms);
  out_.ready.clear();
}

/// Counts a frame that the inner port refuses as sent by this port.
void FaultPort::add_counts() noexcept {
  const hal::CanCounts& now = inner_.counts();
  const auto add = [&](std::uint32_t& to, std::uint32_t hal::CanCounts::*which) {
    hal::count(to, now.*which - inner_counts_.*which);
  };
  add(counts_.expired, &hal::CanCounts::refused);
  add(counts_.expired, &hal::CanCounts::expired);
  add(counts_.outbid, &hal::CanCounts::outbid);
  add(counts_.unheard, &hal::CanCounts::unheard);
  add(counts_.overrun, &hal::CanCounts::overrun);
  add(counts_.bus_offs, &hal::CanCounts::bus_offs);
  add(counts_.not_started, &hal::CanCounts::not_started);
  inner_counts_ = now;
}

bool FaultPort::send(const CanFrame& frame, std::uint8_t lifetime_ms) noexcept {
  return outbox_.put(frame, lifetime_ms, on_bus(), counts_);
}

bool FaultPort::receive(CanFrame& out) noexcept { return inbox_.pop(out, counts_); }

void FaultPort::restart() noexcept {
  if (!is_off_) {
    inner_.restart();
    return;
  }
  is_off_ = false;
  is_restarting_ = true;
}

void FaultPort::poll(std::uint32_t now_ms) noexcept {
  see_state();
  inner_.poll(now_ms);
  see_incoming();
  see_outgoing(now_ms);
  // Polls again, so that frames handed over above leave now.
  inner_.poll(now_ms);
  add_counts();
}

}  // namespace whisker::bus
