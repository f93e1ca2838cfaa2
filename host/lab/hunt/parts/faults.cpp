// When a condition becomes a fault, and when not.
#include "firmware/safety/supervisor.hpp"

#include <algorithm>

#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using safety::Supervisor;

struct Watched {
  Params p;
  Health health;
  Supervisor supervisor{p, health};
  explicit Watched(Dice& dice) {
    if (dice.chance(0.5)) p.safety.period = milliseconds(5 + dice.index(30));
    if (dice.chance(0.5)) p.safety.max_gap = milliseconds(2 * p.safety.period.raw() + 2 + dice.index(150));
    if (dice.chance(0.5)) p.conditioning.stale_after = milliseconds(300 + dice.index(1500));
    supervisor.configure();
    supervisor.reset();
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;
  bool has(Fault fault) const { return health.fault == fault; }
};

std::string judge_gap(Dice& dice) {
  Watched w(dice);
  const int period = w.p.safety.period.raw(), longest = longest_gap(w.p).raw();
  const int at[] = {-1,
                    0,
                    1,
                    period,
                    period + period / 4 - 1,
                    period + period / 4 + 2,
                    longest,
                    longest + 1,
                    longest + dice.index(5000)};
  const int gap = at[dice.index(9)];  // not the very quarter
  const bool excused = dice.chance(0.3);
  w.supervisor.check_gap(milliseconds(gap), excused);
  const bool jump = gap <= 0 || (gap > longest && !excused), late = !jump && gap > period + period / 4;
  if (w.has(Fault::clock_jump) != jump || w.health.clock_jumps != (jump ? 1U : 0U))
    return "another jump of the clock";
  if (w.health.late_ticks != (late ? 1U : 0U)) return "another late tick";
  if (!jump) return "";
  w.supervisor.check_ranges(derived::lost_after(w.p) + 1_ms);
  if (!w.has(Fault::clock_jump)) return "the first fault does not stay";
  w.supervisor.reset();
  return w.supervisor.faulted() ? "a reset leaves a fault" : "";
}

std::string judge_waits(Dice& dice) {
  Watched w(dice);
  const bool lost = dice.chance(0.5);
  w.supervisor.check_ranges(derived::lost_after(w.p) + milliseconds(lost ? 1 : 0));
  if (w.has(Fault::range_lost) != lost) return "a beam is lost at another time";
  Watched look(dice);
  const Duration longest = derived::lost_after(look.p) * (derived::kConsensusReads + 1);
  const bool waits = dice.chance(0.7), late = dice.chance(0.5);
  look.supervisor.check_look(waits, longest + milliseconds(late ? 1 : 0));
  if (look.has(Fault::range_unsteady) != (waits && late)) return "a look is unsteady at another time";
  if (look.health.unsteady_looks != (waits && late ? 1U : 0U)) return "another count of unsteady looks";
  Watched trust(dice);
  const auto level = static_cast<RangeLevel>(dice.index(3));
  trust.supervisor.check_trust(level);
  return trust.has(Fault::range_untrusted) == (level == RangeLevel::untrusted) ? "" : "another trust";
}

/// Refusals of one part; the count begins anew after ten calls in a row that are taken.
std::string judge_refusals(Dice& dice) {
  Watched w(dice);
  const int part = dice.index(3);
  const Fault due = part == 2 ? Fault::bumper_lost : Fault::drive_refused;
  int count = 0, accepted = 0;
  std::uint32_t all = 0;
  const double share = dice.uniform(0.05, 0.6);
  for (int i = 0; i < 300; ++i) {
    const bool taken = !dice.chance(share);
    accepted = taken ? accepted + 1 : 0;
    if (accepted == 10) count = 0;
    if (!taken) {
      ++count;
      ++all;
    }
    if (part == 0) w.supervisor.check_command(taken);
    if (part == 1) w.supervisor.check_counts(taken);
    if (part == 2) w.supervisor.check_bumper(taken);
    if (part == 0 && w.supervisor.refused() == taken) return "refused and not";
    if (w.has(due) != (count >= derived::kMostRefusals)) return "other refusals are a fault";
    const std::uint32_t counted = part == 0   ? w.health.drive_refused
                                  : part == 1 ? w.health.encoder_refused
                                              : w.health.bumper_refused;
    if (counted != all) return "another count of refusals";
    if (w.supervisor.faulted()) return "";
  }
  return "";
}

std::string judge_bumps(Dice& dice) {
  Watched w(dice);
  const Length place = for_body(w.p, 500_mm);
  const bool same = dice.chance(0.5), pauses = dice.chance(0.3);
  for (int i = 1; i <= 40; ++i) {
    const Vec at = same ? Vec{place * dice.index(90) / 100, Length{}} : Vec{place * i * 11 / 10, Length{}};
    if (i == 1 && same) w.supervisor.check_bump({});
    w.supervisor.check_bump(at);
    if (pauses && i % 20 == 0) w.supervisor.overstays({}, false, 10_ms);
    const bool due = same && !pauses && i + 1 > 30;
    if (w.has(Fault::no_progress) != due) return "other presses are a fault";
    if (w.health.bumps != static_cast<std::uint32_t>(same ? i + 1 : i)) return "another count of presses";
  }
  return "";
}

/// Minutes in one place, and longer where wheels are slow; none where the body leaves it or rests.
std::string judge_place(Dice& dice) {
  Watched w(dice);
  w.p.wheels.motor_lag = milliseconds(dice.index(450));
  w.supervisor.configure();
  const Length place = for_body(w.p, 30_mm);
  const int kind = dice.index(3);
  int seconds = 0;
  bool overstays = false;
  for (; seconds < 3000 && !overstays; ++seconds) {
    const Vec at{kind == 0 && seconds % 50 < 25 ? place * 13 / 10 : place * (seconds % 2) / 2, Length{}};
    overstays = w.supervisor.overstays(at, kind != 1, 1000_ms);
  }
  if (w.supervisor.faulted()) return "a body that stays is a fault";
  if (kind < 2) return overstays ? "a body that leaves or rests is stuck" : "";
  if (!overstays) return "a place is never left";
  const double turn_s = std::max(2 * sim::kPi / (turn_rate(w.p).raw() * 1e-6),
                                 sim::kPi * metres(w.p.body.track) / (w.p.wheels.max_speed.raw() * 1e-6));
  const double least = derived::stalled_after(w.p).raw() * 1e-3 * 60 + 30 * turn_s;
  return seconds >= least * 0.99 && seconds < least * 1.5 + 60 ? "" : "a place is left at another time";
}

/// After a reset the wheels may still turn, for half a second.
std::string judge_runaway(Dice& dice) {
  Watched w(dice);
  const int period = w.p.safety.period.raw();
  const bool drives = dice.chance(0.5);
  int ms = 0;
  for (; ms < 4000 && !w.supervisor.faulted(); ms += period) {
    w.supervisor.expect_wheels({}, milliseconds(period), milliseconds(period));
    w.supervisor.check_wheels({drives ? period * 2 : 0, drives ? period * 2 : 0});
  }
  if (!drives) return w.supervisor.faulted() ? "a standing wheel runs away" : "";
  if (!w.has(Fault::wheel_runaway) || w.health.wheel_runaways != 1) return "a runaway is not noticed";
  return ms >= 500 ? "" : "a wheel that is not watched runs away";
}

std::string judge_braking(Dice& dice) {
  Params p;
  p.wheels.max_speed = Speed::from_raw(1000 * (20 + dice.index(3000)));
  p.wheels.max_acceleration = Acceleration::from_raw(1000 * (50 + dice.index(19000)));
  p.wheels.motor_lag = milliseconds(dice.index(500));
  const double due_ms =
      1000.0 * p.wheels.max_speed.raw() / p.wheels.max_acceleration.raw() + 4 * p.wheels.motor_lag.raw();
  return std::abs(safety::braking_time(p).raw() - due_ms) < 2 ? "" : "another braking time";
}

}  // namespace

std::string judge_faults(Dice& dice) {
  for (int i = 0; i < 30; ++i) {
    for (const JudgePart judge :
         {judge_gap, judge_waits, judge_refusals, judge_bumps, judge_place, judge_runaway, judge_braking}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
