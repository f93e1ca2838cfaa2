#include "host/lab/report/encounters.hpp"

#include "host/lab/report/axes.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::report {
namespace {

/// A static scan at a boundary and a stop for a fault do not leave the boundary.
bool leaves(const TickRecord& r) {
  if (doing(r) == Doing::danger) return false;
  switch (r.mode) {
    case planning::Mode::facing:
    case planning::Mode::steering:
    case planning::Mode::probing:
    case planning::Mode::stepping:
    case planning::Mode::going:
    case planning::Mode::arrived:
    case planning::Mode::unreachable: return true;
    case planning::Mode::idle:
    case planning::Mode::looking:
    case planning::Mode::searching:
    case planning::Mode::following:
    case planning::Mode::surveying:
    case planning::Mode::gave_up:
    case planning::Mode::stopped: return false;
  }
  return false;
}

Encounter::End end_of(const TickRecord& r) {
  if (r.mode == planning::Mode::unreachable) return Encounter::End::unreachable;
  return r.why == planning::Why::wall_lost ? Encounter::End::wall_lost : Encounter::End::left;
}

}  // namespace

void EncounterFinder::add(const TickRecord& r) {
  const std::size_t number = count_++;
  if (!drawable({r.x_m, r.y_m})) return;
  if (!inside_ && doing(r) == Doing::danger) {
    found_.push_back({number, {}, {}});
    inside_ = true;
  } else if (inside_ && leaves(r)) {
    found_.back().left = number;
    found_.back().end = end_of(r);
    inside_ = false;
  } else if (inside_ && r.why == planning::Why::came_round && !found_.back().turned) {
    found_.back().turned = number;
  }
}

std::vector<Encounter> encounters(const std::vector<TickRecord>& records) {
  EncounterFinder finder;
  for (const TickRecord& r : records) finder.add(r);
  const auto record = [&](const std::optional<std::size_t>& i) { return i ? &records[*i] : nullptr; };
  std::vector<Encounter> all;
  for (const EncounterFinder::Found& e : finder.found()) {
    all.push_back({&records[e.hit], record(e.turned), record(e.left), e.end});
  }
  return all;
}

std::vector<HandOver> hand_overs(const std::vector<TickRecord>& records) {
  std::vector<HandOver> all;
  bool begun = false;
  bool led = false;
  for (const TickRecord& r : records) {
    const bool leads = guides(r.guide);
    if (begun && leads != led) all.push_back({&r, led});
    begun = begun || leads;
    led = leads;
  }
  return all;
}

}  // namespace whisker::report
