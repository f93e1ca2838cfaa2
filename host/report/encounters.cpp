#include "host/report/encounters.hpp"

#include "host/report/axes.hpp"
#include "host/report/track.hpp"

namespace whisker::report {
namespace {

/// A look at an edge, and a stop for a fault, leave no edge.
bool leaves(const TickRecord& r) {
  if (doing(r) == Doing::danger) return false;
  switch (r.mode) {
    case nav::Mode::facing:
    case nav::Mode::steering:
    case nav::Mode::probing:
    case nav::Mode::stepping:
    case nav::Mode::going:
    case nav::Mode::arrived:
    case nav::Mode::unreachable: return true;
    case nav::Mode::idle:
    case nav::Mode::looking:
    case nav::Mode::searching:
    case nav::Mode::skirting:
    case nav::Mode::surveying:
    case nav::Mode::gave_up:
    case nav::Mode::stopped: return false;
  }
  return false;
}

Encounter::End end_of(const TickRecord& r) {
  if (r.mode == nav::Mode::unreachable) return Encounter::End::unreachable;
  return r.why == nav::Why::wall_lost ? Encounter::End::wall_lost : Encounter::End::left;
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
  } else if (inside_ && r.why == nav::Why::came_round && !found_.back().turned) {
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

}  // namespace whisker::report
