// A controller that starts anew has the default parameters. Whenever it does, the robot must not drive with
// them.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "host/harness/bus/scripted_node.hpp"
#include "host/harness/worlds/generate.hpp"
#include "tests/can/loop.hpp"

namespace whisker {
namespace {

Scenario of_a_larger_robot() {
  worlds::Options options;
  options.seed = 3;
  Scenario scenario = worlds::generate(worlds::Kind::discs, options);
  scenario.robot.body.radius = 100_mm;
  scenario.time_limit_s = 1;
  return scenario;
}

/// The hash of the run; none: the base noticed, and the run begins again.
std::optional<std::uint64_t> hash_with_a_restart_at(std::uint32_t restart_ms, can::SyncMode sync_mode,
                                                    hal::CanPort& base, hal::CanPort& port) {
  hil::HostPlanners planners(kDefaultPlanner);
  auto controller = std::make_unique<can_app::Controller>(port, can::Identity{1, 77, 0}, planners);
  test::SharedTime time([&](std::uint32_t now_ms) {
    if (now_ms == restart_ms)
      controller = std::make_unique<can_app::Controller>(port, can::Identity{1, 78, 0}, planners);
    controller->poll(now_ms);
  });
  hil::Figures figures;
  hil::BusOptions bus;
  bus.sync_mode = sync_mode;
  bus.resend_ms = 3;
  RunOptions options;
  options.pilot = hil::bus_pilot(base, time, bus, figures);
  try {
    return run(of_a_larger_robot(), options).hash;
  } catch (const hil::ControllerRestarted&) {
    return std::nullopt;
  }
}

constexpr std::uint32_t kLast_ms = 150;
constexpr int kNoticedAtLeast = 90;

TEST(Restart, AtAnyMillisecondNeverDrivesWithTheDefaultParameters) {
  const std::uint64_t hash = run(of_a_larger_robot()).hash;
  int noticed = 0;
  for (std::uint32_t ms = 1; ms <= kLast_ms; ++ms) {
    bus::MemoryBus wire;
    const auto got = hash_with_a_restart_at(ms, can::SyncMode::real_time, wire.attach(), wire.attach());
    if (!got) ++noticed;
    EXPECT_EQ(got.value_or(hash), hash) << "restarted at " << ms << " ms";
  }
  EXPECT_GT(noticed, kNoticedAtLeast);
}

/// Lost frames make each step of the beginning longer.
TEST(Restart, NorInLockstepWithLostFrames) {
  const std::uint64_t hash = run(of_a_larger_robot()).hash;
  int noticed = 0;
  for (std::uint32_t ms = 1; ms <= kLast_ms; ++ms) {
    bus::MemoryBus wire;
    test::LossyPort base(wire.attach(), ms), port(wire.attach(), ms + 1);
    const auto got = hash_with_a_restart_at(ms, can::SyncMode::lockstep, base, port);
    if (!got) ++noticed;
    EXPECT_EQ(got.value_or(hash), hash) << "restarted at " << ms << " ms";
  }
  EXPECT_GT(noticed, kNoticedAtLeast);
}

// A foreign node completes the handshake and then leaves a request unanswered: every wait has a time-out, and
// the missing message is named.

Scenario short_way() {
  worlds::Options options;
  options.seed = 3;
  return worlds::generate(worlds::Kind::discs, options);
}

/// A controller that greets, sends heartbeats and answers only these requests: orders with this status.
class Taciturn {
 public:
  Taciturn(bus::MemoryBus& wire, std::set<can::MessageKind> answers, can::MissionStatus status)
      : party_(wire, 1), answers_(std::move(answers)), status_(status) {}

  void poll(std::uint32_t now_ms) {
    party_.poll(now_ms);
    if (now_ms % 100 == 0) party_.greet(kBoot);
    const auto frames = party_.frames();
    party_.forget();
    for (const hal::CanFrame& frame : frames) answer(frame);
  }

 private:
  static constexpr std::uint16_t kBoot = 7;

  bool answers(can::MessageKind kind, const hal::CanFrame& frame) const {
    return answers_.count(kind) != 0 && frame.id >> 4 == can::message_of(kind).function;
  }
  void answer(const hal::CanFrame& frame) {
    can::ParamRequest request;
    can::MissionOrder order;
    if (answers(can::MessageKind::param_request, frame) && can::decode(frame, request)) {
      party_.say(can::ParamReply{can::ParamStatus::ok, request.index, request.value});
    } else if (answers(can::MessageKind::mission, frame) && can::decode(frame, order) &&
               order.part == can::MissionPart::order) {
      party_.say(can::MissionReply{status_, order.mission});
    }
  }

  bus::ScriptedNode party_;
  const std::set<can::MessageKind> answers_;
  const can::MissionStatus status_;
};

/// The plant's message when it gives up, and the seconds that it waited.
std::pair<std::string, double> given_up(const std::set<can::MessageKind>& answers, can::SyncMode sync_mode,
                                        can::MissionStatus status = can::MissionStatus::accepted) {
  bus::MemoryBus wire;
  hal::CanPort& port = wire.attach();
  Taciturn controller(wire, answers, status);
  test::SharedTime time([&](std::uint32_t now_ms) { controller.poll(now_ms); });
  hil::Figures figures;
  hil::BusOptions bus;
  bus.sync_mode = sync_mode;
  bus.patience_ms = 2000;
  RunOptions options;
  options.pilot = hil::bus_pilot(port, time, bus, figures);
  std::string said = "it drove";
  try {
    run(short_way(), options);
  } catch (const hil::NoAnswer& e) {
    said = e.what();
  }
  return {said, static_cast<double>(time.now_us()) * 1e-6};
}

TEST(Silence, ThePlantNamesTheRequestThatStaysWithoutAnAnswer) {
  using can::MessageKind;
  for (const can::SyncMode sync_mode : {can::SyncMode::lockstep, can::SyncMode::real_time}) {
    const auto [param, waited_s] = given_up({}, sync_mode);
    EXPECT_EQ(param, "the controller sends no ParamReply for 2000 ms");
    EXPECT_LT(waited_s, 3);
    const auto [mission, mission_s] = given_up({MessageKind::param_request}, sync_mode);
    EXPECT_EQ(mission, "the controller sends no MissionReply that accepts for 2000 ms");
    EXPECT_LT(mission_s, 4);
    const auto [refusal, refusal_s] =
        given_up({MessageKind::param_request, MessageKind::mission}, sync_mode, can::MissionStatus::refused);
    EXPECT_EQ(refusal, mission);
    EXPECT_LT(refusal_s, 4);
  }
  const auto [set, set_s] =
      given_up({MessageKind::param_request, MessageKind::mission}, can::SyncMode::lockstep);
  EXPECT_EQ(set, "the controller sends no WheelCommand and NavStatus for 2000 ms");
  EXPECT_LT(set_s, 5);
}

/// A controller with a foreign base that falls silent, in real time; returns the reported errors.
TEST(Silence, TheControllerNamesWhatABaseNoLongerSends) {
  bus::MemoryBus wire;
  can::ControllerNode node(wire.attach(), {1, 5, 0});
  bus::ScriptedNode base(wire, 9);
  std::uint32_t now = 0;
  const auto pass = [&](int ms, bool beats) {
    for (int i = 0; i < ms; ++i) {
      base.poll(++now);
      if (beats && now % 50 == 0) base.greet(6);
      node.poll(now);
    }
  };
  pass(1000, false);
  EXPECT_EQ(node.state(), can::NodeState::waiting);
  pass(200, true);
  EXPECT_EQ(node.state(), can::NodeState::ready);
  pass(1000, true);
  EXPECT_EQ(node.state(), can::NodeState::ready) << "no mission, no error";
  EXPECT_EQ(node.errors(), 0U);
  pass(400, false);
  EXPECT_EQ(node.state(), can::NodeState::waiting) << "nothing ran that could be stopped";
}

}  // namespace
}  // namespace whisker
