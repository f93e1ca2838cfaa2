// The guard while one thing is broken, or its operator falls silent.
#include "host/lab/hunt/parts/guard_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

/// One thing breaks: the fault has the right name and comes in its time.
std::string judge_broken(Dice& dice) {
  Params p = draw_guarded(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  p.conditioning.stale_after = milliseconds(150 + dice.index(dice.chance(0.3) ? 1500 : 150));
  if (check(p) != ParamFault::none) return "";
  GuardBench b(dice, p, {});
  b.survey();
  const double v = b.speed() * 0.8;
  b.drive(v, 0, 100);
  if (b.guard.status().health.fault != Fault::none) return "a fault without cause";
  const int what = dice.index(9);
  Fault due = Fault::none;
  int least = 0, most = 0, gap = 10;
  bool stale = false;
  switch (what) {
    case 0:
      b.body.refuses_ranges = true;
      due = Fault::range_lost;
      least = derived::lost_after(p).raw() - 80;
      most = derived::lost_after(p).raw() + 30;
      stale = true;
      break;
    case 1:
      b.body.lost_beam = dice.index(3);
      due = Fault::range_lost;
      least = derived::lost_after(p).raw() - 80;
      most = derived::lost_after(p).raw() + 30;
      stale = true;
      break;
    case 2:
      b.body.refuses_counts = true;
      due = Fault::drive_refused;
      least = 10 * (derived::kMostRefusals - 1);
      most = 10 * (derived::kMostRefusals + 1);
      break;
    case 3:
      b.body.refuses_commands = true;
      due = Fault::drive_refused;
      least = 10 * (derived::kMostRefusals - 1);
      most = 10 * (derived::kMostRefusals + 1);
      break;
    case 4:
      b.body.jump[dice.chance(0.5) ? 0 : 1] +=
          static_cast<std::uint32_t>(dice.chance(0.5) ? 3000 : hal::kEncoderModulus - 3000);
      due = Fault::encoder_jump;
      most = 11;
      break;
    case 5:
      b.body.counted = {0, 0};
      due = Fault::wheels_stalled;
      least = derived::stalled_after(p).raw() - 150;
      most = derived::stalled_after(p).raw() + 200;
      break;
    case 6:
      b.body.counted[dice.chance(0.5) ? 0 : 1] = 0;
      due = Fault::wheels_stalled;
      most = 2500;
      break;
    case 7:
      b.body.counted[dice.chance(0.5) ? 0 : 1] = -1;
      due = Fault::wheel_runaway;
      most = 2500;
      break;
    default:
      gap = dice.chance(0.5) ? longest_gap(p).raw() + 1 : 0;
      due = Fault::clock_jump;
      most = gap + 1;
      break;
  }
  int ms = 0;
  for (; ms <= most + 2000 && b.guard.status().health.fault == Fault::none; ms += gap > 0 ? gap : 1) {
    b.ask(v, 0);
    b.commanded = b.now;
    b.any_command = true;
    b.tick(gap);
    gap = 10;
    if (stale && ms > p.conditioning.stale_after.raw() + 60 && b.guard.status().health.fault == Fault::none) {
      if (b.guard.status().reason != GuardReason::stale_ranges) return "a stale beam is not said";
    }
  }
  const Fault fault = b.guard.status().health.fault;
  if (fault != due) return fault == Fault::none ? "a fault is not noticed" : "a fault has another name";
  if (ms < least || ms > most + 10) return "a fault at another time";
  b.body.refuses_commands = false;
  b.drive(v, 0, 150);
  if (b.guard.status().health.fault != due || !b.body.stands()) return "a fault does not hold";
  // And ends.
  b.body.refuses_ranges = b.body.refuses_counts = false;
  b.body.lost_beam = -1;
  b.body.counted = {1, 1};
  b.guard.reset();
  b.any_command = false;
  b.tick();
  const GuardStatus& s = b.guard.status();
  if (s.health.fault != Fault::none) return "a reset does not end a fault";
  if (!(s.pose.at == Vec{}) || s.pose.heading.raw() != 0) return "a reset does not begin at zero";
  if (s.command.left != 0) return "a command from before a reset";
  b.survey();
  b.drive(v, 0, 100);
  return b.guard.status().health.fault == Fault::none && b.rim_share() > 0.7
             ? b.wrong
             : "it does not drive after a reset";
}

/// The time-out of a command, to the tick.
std::string judge_timeout(Dice& dice) {
  Params p = draw_guarded(dice);
  p.guard.nods = p.guard.assist = Fitted::no;
  GuardBench b(dice, p, {});
  if (b.tick().reason != GuardReason::stale_ranges && b.guard.status().reason != GuardReason::command_timeout)
    return "a reason without a command";
  b.survey();
  b.drive(b.speed() * 0.5, 0, 80);
  for (int ms = 10; ms < p.guard.command_timeout.raw() + 400; ms += 10) {
    b.tick();
    const bool over = static_cast<int>(b.now - b.commanded) > p.guard.command_timeout.raw();
    if (over != (b.guard.status().reason == GuardReason::command_timeout))
      return "a time-out at another time";
    if (!over && b.rim_share() < 0.4) return "it brakes before the time-out";
  }
  b.tick();
  for (int i = 0; i < 150; ++i) b.tick();
  return b.body.stands() ? b.wrong : "it does not stand after a time-out";
}

}  // namespace

std::string judge_broken_body(Dice& dice) {
  for (const JudgePart judge : {judge_broken, judge_broken, judge_timeout}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
