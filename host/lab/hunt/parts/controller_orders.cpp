// How the node that decides answers orders and requests.
#include <set>

#include "firmware/params/words.hpp"
#include "host/harness/scenario/param_list.hpp"
#include "host/lab/hunt/parts/controller_bench.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

std::string judge_orders(Dice& dice) {
  ControllerBench b(dice);
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(2);
  const bool calibrates = dice.chance(0.5);
  if (calibrates) b.node.accept_calibrations();
  bool has_mission = false, stopped = false;
  for (int i = 0; i < 14; ++i) {
    ++b.mission;
    const int kind = dice.index(8);
    Mission m = b.draw_mission();
    if (kind == 0) {
      b.peer.say(MissionOrder{MissionPart::order, b.mission, Order::start, 0});
      b.pass(2);
      if (!b.replied(MissionStatus::incomplete)) return "half an order is complete";
      continue;
    }
    if (kind == 1) {
      b.peer.send({0x010, false, false, 1, {0}});
      b.pass(2);
      stopped = true;
      if (b.node.state() != NodeState::e_stopped) return "no emergency stop";
      continue;
    }
    if (kind == 2 && stopped) {
      b.peer.say(EStop{kClearCommand});
      b.pass(2);
      stopped = false;
      if (b.node.state() == NodeState::e_stopped) return "a clear does not clear";
      continue;
    }
    const auto what = static_cast<Order>(dice.index(kOrders));
    const bool beyond = dice.chance(0.2);
    if (beyond)
      (dice.chance(0.5) ? m.goal.at.x : m.start.at.y) =
          (kPlaceLimit + micrometres(1)) * (dice.chance(0.5) ? 1 : -1);
    const bool is_short = dice.chance(0.3);
    if (is_short && !beyond) m.goal.at = m.start.at + Vec{dice.chance(0.5) ? 499_mm : 500_mm, 0_mm};
    const bool too_short = is_short && !beyond && m.goal.at.x - m.start.at.x == 499_mm;
    b.order(b.peer, what, m);
    const bool calibration = can::calibrates(what);
    MissionStatus due = MissionStatus::accepted;
    if (beyond)
      due = MissionStatus::out_of_range;
    else if (what == Order::resume && !has_mission)
      due = MissionStatus::unknown;
    else if (calibration && !calibrates)
      due = MissionStatus::unsupported;
    else if (calibration && what != Order::spin && too_short)
      due = MissionStatus::out_of_range;
    else if (can::drives(what) && stopped)
      due = MissionStatus::refused;
    if (!b.replied(due)) return "another answer to an order";
    if (due != MissionStatus::accepted) continue;
    has_mission = can::drives(what);
    if ((b.node.state() == NodeState::running) != (has_mission && !stopped))
      return "another state after an order";
    if (b.ordered != what) return "another order is taken";
    b.pass(30);
    if (!b.wrong.empty()) return b.wrong;
  }
  ++b.boot;
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(5);
  ++b.mission;
  b.order(b.peer, Order::resume, b.draw_mission());
  return b.replied(MissionStatus::unknown) ? "" : "a mission of another base goes on";
}

/// Every parameter reads back as written, and nothing else changes before a commit.
std::string judge_params(Dice& dice) {
  ControllerBench b(dice);
  b.peer.greet(b.boot, NodeState::ready);
  b.pass(2);
  const bool by_hand = dice.chance(0.3);
  bus::ScriptedNode& voice = by_hand ? b.hand : b.peer;
  const auto ask = [&](ParamAction action, int index, std::int64_t raw, ParamReply& reply) {
    b.peer.forget();
    voice.say(ParamRequest{action, static_cast<std::uint8_t>(index), static_cast<std::uint32_t>(raw)});
    b.pass(2);
    return b.peer.last(reply) && reply.index == index && (reply.to_operator != 0) == by_hand;
  };
  const std::vector<ParamEntry> usual = param_list(Params{});
  ParamReply reply;
  for (int i = 0; i < 12; ++i) {
    const auto k = static_cast<std::size_t>(dice.index(static_cast<int>(usual.size())));
    const ParamEntry now = param_list(b.node.params())[k];
    if (!ask(ParamAction::read, now.number, 0, reply) ||
        static_cast<std::int32_t>(reply.value) != static_cast<std::int32_t>(now.raw))
      return "a parameter reads otherwise";
    const int how = dice.index(3);
    const std::int64_t raw =
        how == 0   ? now.low - 1
        : how == 1 ? now.high + 1
                   : now.low + static_cast<std::int64_t>(dice.uniform(0, 1) *
                                                         static_cast<double>(now.high - now.low));
    if (raw != static_cast<std::int64_t>(static_cast<std::int32_t>(raw)) && now.low >= 0 && how == 0)
      continue;
    if (!ask(ParamAction::write, now.number, raw, reply)) return "a write is not answered";
    const bool in = how == 2;
    if (now.high < INT32_MAX && now.low > INT32_MIN && (reply.status == ParamStatus::ok) != in)
      return "another range of a parameter";
    if (param_list(b.node.params())[k].raw != now.raw) return "a write takes effect before its commit";
    if (reply.status != ParamStatus::ok) continue;
    Params wanted = b.node.params();
    set_param(wanted, k, raw);
    const bool fits = check(wanted) == ParamFault::none && outlasts_hold(wanted);
    if (!ask(ParamAction::commit, kCommitIndex, 0, reply)) return "a commit is not answered";
    if ((reply.status == ParamStatus::ok) != fits) return "another commit";
    if (param_list(b.node.params())[k].raw != (fits ? raw : now.raw))
      return "a commit that changes otherwise";
    if (!fits && !ask(ParamAction::write, now.number, now.raw, reply)) return "no way back";
  }
  // Also what the robot derives.
  std::set<int> numbers;
  for (const ParamEntry& e : usual) numbers.insert(e.number);
  for (int number = 0; number <= kParams; ++number) {
    if (numbers.count(number) > 0) continue;
    for (const ParamAction action : {ParamAction::read, ParamAction::write}) {
      if (!ask(action, number, 1, reply) || reply.status != ParamStatus::no_such)
        return "a parameter too many";
    }
  }
  b.order(b.peer, Order::start, b.draw_mission());
  if (!b.replied(MissionStatus::accepted)) return "no start after parameters";
  const auto first = static_cast<std::uint32_t>(usual[0].raw);
  if (!ask(ParamAction::write, 0, first, reply) || reply.status != ParamStatus::busy)
    return "a write while it drives";
  if (!ask(ParamAction::commit, kCommitIndex, 0, reply) || reply.status != ParamStatus::busy)
    return "a commit while it drives";
  return ask(ParamAction::read, 0, 0, reply) && reply.status == ParamStatus::ok ? ""
                                                                                : "no read while it drives";
}

/// An operator may give orders where the program says so, while the base's own mission stands.
std::string judge_operator(Dice& dice) {
  ControllerBench b(dice);
  const bool takes = dice.chance(0.7);
  if (takes) b.node.accept_operator_orders();
  std::string wrong = b.start();
  if (!wrong.empty()) return wrong;
  const auto order = [&](Order what, const Mission& m) {
    b.peer.forget();
    const MissionValues values = values_of(m);
    for (int i = 0; i < kMissionValues; ++i)
      b.hand.say(MissionValue{static_cast<MissionPart>(i + 1), 99, values.of[i]});
    b.hand.say(MissionOrder{MissionPart::order, 99, what, digest_of(values)});
    b.pass(2);
    MissionReply reply;
    return b.peer.last(reply) && reply.mission == 99 && reply.to_operator == 1
               ? static_cast<int>(reply.status)
               : -1;
  };
  const int busy = order(Order::start, b.draw_mission());
  const MissionStatus due = !takes ? MissionStatus::unsupported : MissionStatus::refused;
  if (busy != static_cast<int>(due)) return "an operator interrupts a drive";
  if (!takes) return "";
  b.speeds = {};
  b.status.outcome = planning::Outcome::none;
  b.pass(1500);
  const Mission m = b.draw_mission();
  if (order(Order::start, m) != static_cast<int>(MissionStatus::accepted))
    return "an operator's order is refused";
  Order what = Order::cancel;
  planning::Goal goal{};
  if (!b.node.take_operator_order(what, goal) || what != Order::start || !(goal == m.goal))
    return "another order of the operator";
  if (b.node.take_operator_order(what, goal)) return "an operator's order comes twice";
  return b.orders == 1 ? "" : "an operator's order is one of the base";
}

}  // namespace

std::string judge_orders_of_controller(Dice& dice) {
  for (const JudgePart judge : {judge_orders, judge_params, judge_operator}) {
    std::string wrong = judge(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
