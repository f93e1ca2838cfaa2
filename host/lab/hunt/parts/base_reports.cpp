// What the node with the wheels hands on in both directions.
#include "host/lab/hunt/parts/base_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

/// What the controller reports is handed on, and forgotten with the controller.
std::string judge_reports(Dice& dice) {
  BaseBench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  const auto word = [&] { return static_cast<std::uint16_t>(dice.index(16000)); };
  const RangeTrustReport trust{RangeLevel::doubtful, word(), 5, 6, static_cast<std::uint8_t>(dice.index(91))};
  const PoseSigmaReport sigma{1, word(), word(), word()};
  const FixReply fix{FixStatus::accepted, word(), word(), word()};
  const ParamReply param{ParamStatus::ok, static_cast<std::uint8_t>(dice.index(200)),
                         static_cast<std::uint32_t>(dice.bits())};
  const RulesReply rules{};
  NavStatus nav;
  nav.danger = 9;
  nav.fault = 2;
  RangeTrustReport t;
  PoseSigmaReport s;
  FixReply f;
  ParamReply p;
  RulesReply r;
  if (b.base.reported(t) || b.base.reported(s) || b.base.replied(f) || b.base.replied(p) || b.base.take(r))
    return "a report from nowhere";
  b.peer.say(ParamReply{ParamStatus::ok, 1, 2, 1});
  b.pass(2);
  if (b.base.replied(p)) return "an answer to the operator counts";
  const std::uint32_t at = b.tick;
  nav.tick = static_cast<std::uint16_t>(at);
  b.answers = false;
  b.peer.say(WheelCommand{DriveMode::drive, {100, 200}, static_cast<std::uint16_t>(at)});
  b.pass();
  if (b.base.answered(at)) return "half an answer";
  b.peer.say(trust);
  b.peer.say(sigma);
  b.peer.say(fix);
  b.peer.say(param);
  b.peer.say(rules);
  b.peer.say(nav);
  b.pass(2);
  b.answers = true;
  if (!b.base.reported(t) || t.contradictions != trust.contradictions || t.level != trust.level ||
      t.incidence != trust.incidence)
    return "another trust";
  if (!b.base.reported(s) || s.along != sigma.along || s.across != sigma.across || s.heading != sigma.heading)
    return "another sigma";
  if (!b.base.replied(f) || f.tick != fix.tick || f.jumps != fix.jumps || f.refused != fix.refused)
    return "another answer to a fix";
  if (!b.base.replied(p) || p.index != param.index || p.value != param.value)
    return "another answer to a parameter";
  if (!b.base.take(r) || b.base.take(r)) return "an answer to rules is not taken once";
  if (b.base.status().danger != 9 || b.base.status().fault != 2 || b.base.status().tick != nav.tick)
    return "another status";
  if (!b.base.answered(at) || b.base.answered(at + 1)) return "another tick is answered";
  if (b.base.command().speeds.left != 100 || b.base.command().speeds.right != 200) return "another command";
  b.base.request(ParamRequest{ParamAction::read, 3, 0});
  if (b.base.replied(p)) return "an answer before its request";
  // Too old.
  const std::uint32_t stale = b.base.health().stale;
  b.peer.say(WheelCommand{DriveMode::drive, {77, 77}, static_cast<std::uint16_t>(b.tick - 7)});
  b.pass();
  if (b.base.command().speeds.left == 77 || b.base.health().stale != stale + 1)
    return "an old command counts";
  ++b.peer_boot;
  b.peer.greet(b.peer_boot, NodeState::ready);
  b.pass(2);
  if (b.base.reported(t) || b.base.reported(s) || b.base.replied(f) || b.base.replied(p) ||
      b.base.answered(at))
    return "reports of an earlier life";
  return "";
}

std::string judge_sets(Dice& dice) {
  BaseBench b(dice);
  std::string wrong = b.start(dice);
  if (!wrong.empty()) return wrong;
  for (int i = 0; i < 10; ++i) {
    InputSet& set = b.set;
    for (hal::RangeReading& r : set.ranges.beam) {
      r = {static_cast<std::uint16_t>(dice.index(65536)), static_cast<hal::RangeStatus>(dice.index(5)),
           static_cast<std::uint8_t>(dice.index(256)), static_cast<std::uint8_t>(dice.index(256))};
    }
    set.counts = {static_cast<std::uint32_t>(dice.index(1 << 24)),
                  static_cast<std::uint32_t>(dice.index(1 << 24))};
    set.counts_valid = dice.chance(0.5);
    for (BumpState& s : set.bumps) s = static_cast<BumpState>(dice.index(4));
    set.has_gyro = dice.chance(0.5);
    set.gyro_valid = dice.chance(0.5);
    set.gyro.sum = static_cast<std::uint32_t>(dice.index(1 << 24));
    set.gyro.samples = static_cast<std::uint16_t>(dice.index(65536));
    set.has_fix = dice.chance(0.5);
    set.fix.pose.at = {millimetres(dice.index(100000)), millimetres(dice.index(1000))};
    while (b.now % 10 != 9) b.pass();
    b.peer.forget();
    b.pass(2);
    Sync sync;
    WheelState wheels;
    GyroState gyro;
    Range<MessageKind::range_left> left;
    Range<MessageKind::range_front> front;
    Range<MessageKind::range_right> right;
    if (!b.peer.last(sync) || sync.tick != b.tick || sync.period_ms != 10 ||
        (sync.gyro != 0) != set.has_gyro || (sync.fix != 0) != set.has_fix)
      return "another sync";
    if (!b.peer.last(wheels) || wheels.counts.left != set.counts.left ||
        wheels.counts.right != set.counts.right || (wheels.valid != 0) != set.counts_valid ||
        wheels.tick != b.tick % 8)
      return "other counts are sent";
    if (!b.peer.last(left) || !b.peer.last(front) || !b.peer.last(right)) return "no ranges";
    const hal::RangeReading* const sent[] = {&left.reading, &front.reading, &right.reading};
    const std::uint16_t ticks[] = {left.tick, front.tick, right.tick};
    const BumpState bumps[] = {left.bump, front.bump, right.bump};
    for (int k = 0; k < 3; ++k) {
      const hal::RangeReading& r = set.ranges.beam[k];
      const bool ok = r.status == hal::RangeStatus::ok && r.mm < 65534;
      if (ok && (sent[k]->mm != r.mm || sent[k]->status != r.status)) return "another distance is sent";
      if (!ok && sent[k]->mm < 65534) return "a distance that there is not is sent";
      if (sent[k]->age_ms != r.age_ms || sent[k]->sequence != r.sequence % 16) return "another age is sent";
      if (ticks[k] != static_cast<std::uint16_t>(b.tick) || bumps[k] != set.bumps[k])
        return "another bump is sent";
    }
    const bool any = b.peer.last(gyro);
    if (any != set.has_gyro) return "a gyro or none";
    if (any && (gyro.reading.sum != set.gyro.sum || gyro.reading.samples != set.gyro.samples ||
                (gyro.valid != 0) != set.gyro_valid || gyro.tick != b.tick % 8))
      return "another gyro is sent";
    int parts = 0;
    bool fits = true;
    b.peer.each<FixValue>([&](const FixValue& v) {
      ++parts;
      if (v.part == FixPart::x) fits = fits && v.value == static_cast<std::uint32_t>(set.fix.pose.at.x.raw());
      fits = fits && v.tick == static_cast<std::uint16_t>(b.tick);
    });
    if (parts != (set.has_fix ? kFixValues : 0) || !fits) return "another fix is sent";
  }
  return "";
}

}  // namespace

std::string judge_reports_of_base(Dice& dice) {
  for (const JudgePart judge : {judge_reports, judge_sets}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
