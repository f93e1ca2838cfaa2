/// A base node on a bus in memory, beside a controller that a judge plays.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

#include "firmware/can/base_node.hpp"
#include "firmware/can/limits.hpp"
#include "host/harness/bus/scripted_node.hpp"
#include "host/lab/hunt/dice.hpp"

namespace whisker::hunt {

using namespace can;

constexpr std::uint16_t kBoot = 500;
constexpr std::int16_t kRamp = 100;

/// The base, and a controller that greets, answers and falls silent as told.
struct BaseBench {
  bus::MemoryBus wire;
  BaseNode base{wire.attach(), {1, kBoot, 0x000100}, kRamp};
  bus::ScriptedNode peer{wire, 1};
  bus::ScriptedNode stranger{wire, 3};
  std::uint32_t began, now, tick = 0;
  std::uint16_t peer_boot = 600;
  bool beats = true, answers = true;
  NodeState peer_state = NodeState::running;
  hal::WheelSpeeds asked{2000, 1500}, speeds{};
  InputSet set;

  explicit BaseBench(Dice& dice)
      : began(dice.chance(0.3) ? 0xFFFFF000U : static_cast<std::uint32_t>(dice.index(100000))) {
    now = began;
    peer.poll(now);
    base.poll(now);
  }
  void pass() {
    ++now;
    peer.poll(now);
    if (beats && now % 100 == 0) {
      Heartbeat beat;
      beat.boot = peer_boot;
      beat.state = peer_state;
      peer.say(beat);
    }
    base.poll(now);
    if (now % 10 != 0) return;
    speeds = base.control();
    set.tick = ++tick;
    base.send_set(set, SyncMode::real_time);
    if (answers) peer.say(WheelCommand{DriveMode::drive, asked, static_cast<std::uint16_t>(tick)});
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
  std::string start(Dice& dice) {
    if (base.state() != NodeState::waiting) return "not waiting at first";
    pass(dice.index(50));
    if (base.state() != NodeState::waiting || speeds.left != 0) return "it does not wait for a controller";
    peer.greet(peer_boot, NodeState::ready);
    pass(2);
    if (base.state() != NodeState::ready || !base.matched()) return "no handshake";
    return order(dice);
  }
  std::string order(Dice& dice) {
    const auto length = [&] { return micrometres(dice.index(2000000) - 1000000); };
    const Mission mission{{{length(), length()}, Angle::turns(dice.index(360), 360)},
                          {{length(), length()}, millimetres(1 + dice.index(200))}};
    peer.forget();
    base.give(Order::start, mission, SyncMode::real_time);
    const int silent_ms = 2 + dice.index(300);
    pass(silent_ms);
    MissionOrder said;
    if (!peer.last(said) || said.order != Order::start || base.order_state() != OrderState::waiting)
      return "no order";
    const MissionValues values = values_of(mission);
    if (said.digest != digest_of(values)) return "another digest of the order";
    int parts = 0;
    bool right = true;
    peer.each<MissionValue>([&](const MissionValue& m) {
      if (m.part == MissionPart::order) return;
      ++parts;
      right = right && m.mission == said.mission && m.value == values.of[static_cast<int>(m.part) - 1];
    });
    if (!right) return "other parts of the order";
    const int repeats = 1 + (silent_ms - 2) / static_cast<int>(kOrderRepeat_ms);
    if (std::abs(parts / kMissionValues - repeats) > 1) return "an order is not repeated in its time";
    // Of another order, to the operator, or incomplete: it waits on.
    peer.say(MissionReply{MissionStatus::accepted, static_cast<std::uint8_t>(said.mission + 1)});
    peer.say(MissionReply{MissionStatus::accepted, said.mission, 1});
    pass(2);
    if (base.order_state() != OrderState::waiting || base.state() == NodeState::running)
      return "a strange answer counts";
    if (dice.chance(0.3)) {
      const int before = peer.heard<MissionOrder>();
      peer.say(MissionReply{MissionStatus::incomplete, said.mission});
      pass(3);
      if (peer.heard<MissionOrder>() == before) return "an incomplete order is not repeated at once";
    }
    peer.say(MissionReply{MissionStatus::accepted, said.mission});
    pass(2);
    if (base.order_state() != OrderState::accepted || base.order_status() != MissionStatus::accepted)
      return "not accepted";
    const int orders = peer.heard<MissionOrder>();
    pass(60);
    if (peer.heard<MissionOrder>() != orders) return "an accepted order is repeated";
    if (base.state() != NodeState::running) return "it does not run";
    return speeds.left == asked.left && speeds.right == asked.right ? "" : "another speed than commanded";
  }
  /// Scaled down together, the faster wheel by the ramp a period.
  std::string brakes() {
    while (now % 10 != 9) pass();
    for (int i = 0; i < 40; ++i) {
      const hal::WheelSpeeds before = speeds;
      pass(10);
      const int fastest = std::max(std::abs(before.left), std::abs(before.right));
      const double share = fastest > kRamp ? static_cast<double>(fastest - kRamp) / fastest : 0;
      if (std::abs(speeds.left - before.left * share) > 1.01 ||
          std::abs(speeds.right - before.right * share) > 1.01) {
        return "it brakes otherwise";
      }
    }
    return speeds.left == 0 && speeds.right == 0 ? "" : "it does not stand";
  }
};

}  // namespace whisker::hunt
