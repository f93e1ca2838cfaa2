/// A controller node on a bus in memory, beside a base and an operator that a judge plays.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

#include "firmware/can/controller_node.hpp"
#include "firmware/can/limits.hpp"
#include "host/harness/bus/scripted_node.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

using namespace can;

constexpr std::uint16_t kBoot = 500;

/// The controller, and a base that greets, measures and falls silent as told.
struct ControllerBench {
  bus::MemoryBus wire;
  ControllerNode node{wire.attach(), {1, kBoot, 0x000100, 0x1234}};
  bus::ScriptedNode peer{wire, 9};
  bus::ScriptedNode hand{wire, 1};  // the operator's frames have the node's number
  Dice& dice;
  std::uint32_t now, tick;
  std::uint16_t boot = 600;
  std::uint8_t mission = 7;
  SyncMode sync = SyncMode::real_time;
  bool beats = true, sends[5] = {true, true, true, true, true};
  int steps = 0, orders = 0;
  Order ordered = Order::cancel;
  Mission got;
  hal::RangeReading ranges[3] = {};
  hal::EncoderCounts counts{};
  hal::WheelSpeeds speeds{1000, 900};
  NavStatus status;
  std::string wrong;

  explicit ControllerBench(Dice& d) : dice(d) {
    now = dice.chance(0.3) ? 0xFFFFF800U : static_cast<std::uint32_t>(dice.index(100000));
    tick = dice.chance(0.3) ? 0xFFFFFFF0U : static_cast<std::uint32_t>(dice.index(100000));
    status.why = planning::Why::target_free;
    status.danger = static_cast<std::uint8_t>(dice.index(200));
    for (hal::RangeReading& r : ranges)
      r = {static_cast<std::uint16_t>(dice.index(2000)), hal::RangeStatus::ok,
           static_cast<std::uint8_t>(dice.index(200)), static_cast<std::uint8_t>(dice.index(16))};
    peer.poll(now);
    node.poll(now);
    hand.poll(now);
  }
  /// In any order; the last one is the sync.
  void send_set(std::uint32_t t) {
    const auto t16 = static_cast<std::uint16_t>(t);
    const int first = dice.index(4);
    for (int i = 0; i < 4; ++i) {
      const int k = (first + i) % 4;
      if (!sends[k]) continue;
      if (k == 0) peer.say(Range<MessageKind::range_left>{ranges[0], t16});
      if (k == 1) peer.say(Range<MessageKind::range_front>{ranges[1], t16});
      if (k == 2) peer.say(Range<MessageKind::range_right>{ranges[2], t16});
      if (k == 3) peer.say(WheelState{1, static_cast<std::uint8_t>(t % 8), counts});
    }
    if (sends[4]) peer.say(Sync{sync, t, 10, mission});
  }
  void pass() {
    ++now;
    if (beats && now % 100 == 0) {
      Heartbeat beat;
      beat.boot = boot;
      beat.state = NodeState::running;
      peer.say(beat);
    }
    if (now % 10 == 0 && sync == SyncMode::real_time) send_set(++tick);
    peer.poll(now);
    node.poll(now);
    hand.poll(now);
    if (node.take_order(ordered, got)) ++orders;
    InputSet set;
    if (node.take_set(set)) take(set);
    peer.poll(now);
  }
  void take(const InputSet& set) {
    ++steps;
    if (set.tick != tick) wrong = "a set of another tick";
    if (!set.counts_valid || set.counts.left != counts.left || set.counts.right != counts.right ||
        set.period_ms != 10)
      wrong = "other counts in a set";
    for (int i = 0; i < 3; ++i) {
      const hal::RangeReading& r = set.ranges.beam[i];
      if (r.mm != ranges[i].mm || r.age_ms != ranges[i].age_ms || r.sequence != ranges[i].sequence)
        wrong = "other ranges in a set";
    }
    node.answer(speeds, status);
  }
  void pass(int ms) {
    for (int i = 0; i < ms; ++i) pass();
  }
  template <class F>
  int until(const F& holds) {
    int ms = 0;
    while (ms < 1000 && !holds()) {
      pass();
      ++ms;
    }
    return ms;
  }
  void order(bus::ScriptedNode& voice, Order what, const Mission& m) {
    const MissionValues values = values_of(m);
    for (int i = 0; i < kMissionValues; ++i)
      voice.say(MissionValue{static_cast<MissionPart>(i + 1), mission, values.of[i]});
    voice.say(MissionOrder{MissionPart::order, mission, what, digest_of(values)});
    pass(2);
  }
  Mission draw_mission() {
    const auto length = [&] { return micrometres(dice.index(2000000) - 1000000); };
    return {{{length(), length()}, Angle::turns(dice.index(360), 360)},
            {{length() + 3_m, length()}, millimetres(1 + dice.index(200))}};
  }
  /// Also that the answer is to this order, and to the base.
  bool replied(MissionStatus due) const {
    MissionReply reply;
    return peer.last(reply) && reply.mission == mission && reply.status == due && reply.to_operator == 0;
  }
  DriveMode mode() const {
    WheelCommand command;
    peer.last(command);
    return command.mode;
  }
  std::string start() {
    if (node.state() != NodeState::waiting) return "not waiting at first";
    peer.greet(boot, NodeState::ready);
    pass(2);
    if (node.state() != NodeState::ready) return "no handshake";
    bool rules = false;
    peer.each<Info>(
        [&](const Info& i) { rules = rules || (i.part == InfoPart::rules_hash && i.value == 0x1234); });
    if (!rules) return "it does not tell its rules";
    pass(50);
    if (steps != 0 || mode() != DriveMode::stop) return "it drives without a mission";
    if (std::abs(peer.heard<WheelCommand>() - 5) > 1) return "stops of another period";
    const Mission m = draw_mission();
    const int before = orders;
    order(peer, Order::start, m);
    if (!replied(MissionStatus::accepted) || orders != before + 1 || ordered != Order::start)
      return "a start is not accepted once";
    if (!(got.start.at == m.start.at) || !(got.goal == m.goal)) return "another mission";
    order(peer, Order::start, m);
    if (!replied(MissionStatus::accepted) || orders != before + 1) return "a repeated order is another one";
    pass(60);
    if (node.state() != NodeState::running || steps < 4) return "it does not step";
    while (now % 10 != 1) pass();
    return wrong;
  }
};

}  // namespace whisker::hunt
