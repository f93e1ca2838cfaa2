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

std::vector<Encounter> encounters(const std::vector<TickRecord>& records) {
  std::vector<Encounter> all;
  bool inside = false;
  for (const TickRecord& r : records) {
    if (!drawable({r.x_m, r.y_m})) continue;
    if (!inside && doing(r) == Doing::danger) {
      all.push_back({&r});
      inside = true;
    } else if (inside && leaves(r)) {
      all.back().left = &r;
      all.back().end = end_of(r);
      inside = false;
    } else if (inside && r.why == nav::Why::came_round && all.back().turned == nullptr) {
      all.back().turned = &r;
    }
  }
  return all;
}

}  // namespace whisker::report
