#include "tests/can/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "host/harness/hil/planners.hpp"
#include "host/harness/hil/tap.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"
#include "tests/can/rig.hpp"
#include "tests/effort.hpp"
#include "tests/unseen_disc.hpp"

namespace whisker {
namespace {

class EveryWorld : public testing::TestWithParam<worlds::Kind> {};

Scenario scenario_of(worlds::Kind kind) {
  worlds::Options options;
  options.seed = 3;
  options.noise = true;
  Scenario s = worlds::generate(kind, options);
  s.time_limit_s = 60;
  return s;
}

TEST_P(EveryWorld, TheTrajectoryOverTheBusIsTheOneInProcess) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  const auto over_bus =
      test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep, wire.attach(), wire.attach());
  const RunResult direct = run(scenario);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
  EXPECT_EQ(over_bus.result.ticks, direct.ticks);
  EXPECT_EQ(over_bus.result.verdict, direct.verdict);
  EXPECT_EQ(over_bus.result.detail, direct.detail);
  EXPECT_GT(direct.ticks, 100U);
}

TEST(Shadow, ThatStepsOtherwiseIsSaidAndTheControllerKeepsItsWord) {
  const Scenario scenario = scenario_of(worlds::Kind::discs);
  RunOptions options;
  options.planner = *planner_named("skirt");
  const RunResult direct = run(scenario, options);
  bus::MemoryBus wire;
  hal::CanPort& base = wire.attach();
  hil::HostPlanners planners(options.planner);
  can_app::Controller controller(wire.attach(), {1, 77, 0}, planners);
  test::SharedTime time([&](std::uint32_t now_ms) { controller.poll(now_ms); });
  hil::Shadow shadow(1, *planner_named("thesis"));
  hil::Tap tap(base, [&](const hal::CanFrame& frame) { shadow.hear(frame, time.now_us()); });
  int told = 0;
  hil::BusOptions bus;
  bus.shadow = &shadow;
  bus.say = [&](const std::string& words) {
    told += words.rfind("what is inside the controller is not known any more: tick ", 0) == 0 ? 1 : 0;
  };
  hil::Figures figures;
  options.pilot = hil::bus_pilot(tap, time, bus, figures);
  const RunResult result = run(scenario, options);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(result.hash, direct.hash);
  EXPECT_EQ(result.verdict, direct.verdict);
}

TEST(Shadow, OfOtherParametersShowsNoGridBeforeItsFirstStep) {
  Scenario scenario = scenario_of(worlds::Kind::discs);
  scenario.goal.at = {scenario.start.at.x + 0.3, scenario.start.at.y};
  bus::MemoryBus wire;
  hal::CanPort& base = wire.attach();
  hil::HostPlanners planners(kDefaultPlanner);
  can_app::Controller controller(wire.attach(), {1, 77, 0}, planners);
  test::SharedTime time([&](std::uint32_t now_ms) { controller.poll(now_ms); });
  hil::Shadow shadow(1, kDefaultPlanner);
  int shown = 0, gone = 0;
  bool shows = false;
  hil::Tap tap(base, [&](const hal::CanFrame& frame) {
    shadow.hear(frame, time.now_us());
    shadow.follow();
    const bool now = shadow.local_grid() != nullptr;
    shown += now && !shows ? 1 : 0;
    gone += shows && !now ? 1 : 0;
    shows = now;
  });
  RunOptions options;
  const hil::BusOptions bus;
  hil::Figures figures;
  options.pilot = hil::bus_pilot(tap, time, bus, figures);
  for (const Length radius : {scenario.robot.body.radius, scenario.robot.body.radius - 5_mm}) {
    scenario.robot.body.radius = radius;
    EXPECT_EQ(run(scenario, options).verdict, Verdict::reached);
  }
  EXPECT_EQ(shown, 2);
  EXPECT_EQ(gone, 1);
  EXPECT_EQ(shadow.difference(), "");
}

TEST_P(EveryWorld, TheTrajectoryIsTheSameWithTwoPercentOfTheFramesDropped) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  test::LossyPort base(wire.attach(), 1), controller(wire.attach(), 2);
  const auto over_bus =
      test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep, base, controller);
  const RunResult direct = run(scenario);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
  EXPECT_EQ(over_bus.result.ticks, direct.ticks);
  EXPECT_GT(over_bus.figures.resent, direct.ticks / 20);
  EXPECT_GT(base.dropped() + controller.dropped(), direct.ticks / 10);
  EXPECT_EQ(over_bus.figures.health.stops, 0U);
}

TEST_P(EveryWorld, InRealTimeWithoutAMissToo) {
  const Scenario scenario = scenario_of(GetParam());
  bus::MemoryBus wire;
  const auto over_bus = test::drive_over_bus(scenario, PlannerKind::thesis, can::SyncMode::real_time,
                                             wire.attach(), wire.attach());
  RunOptions options;
  options.planner = PlannerKind::thesis;
  const RunResult direct = run(scenario, options);
  EXPECT_EQ(over_bus.figures.misses, 0U);
  EXPECT_EQ(over_bus.result.hash, direct.hash);
}

TEST(Lockstep, ABaseThatLosesSightOfTheControllerDrivesTheSame) {
  const Scenario scenario = scenario_of(worlds::Kind::discs);
  bus::MemoryBus wire;
  test::Slowness slow;
  slow.base_stalls = 37;
  const auto over_bus = test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep,
                                             wire.attach(), wire.attach(), slow);
  EXPECT_EQ(over_bus.result.hash, run(scenario).hash);
  EXPECT_EQ(over_bus.figures.health.stops, 0U);
  EXPECT_GT(*std::max_element(over_bus.figures.round_trip_us.begin(), over_bus.figures.round_trip_us.end()),
            slow.stall_us);
}

TEST(Lockstep, ASlowControllerGetsFewSetsTwice) {
  const Scenario scenario = scenario_of(worlds::Kind::discs);
  bus::MemoryBus wire;
  test::Slowness slow;
  slow.controller = 25;
  const auto over_bus = test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep,
                                             wire.attach(), wire.attach(), slow);
  EXPECT_EQ(over_bus.result.hash, run(scenario).hash);
  EXPECT_LE(over_bus.figures.resent, 10U);
  EXPECT_GT(over_bus.figures.sets, 1000U);
}

TEST(Lockstep, HeartbeatsThatComeTooLateStopNothing) {
  Scenario scenario = scenario_of(worlds::Kind::discs);
  scenario.time_limit_s = 5;
  for (const std::uint32_t every_ms : {50U, 290U, 350U, 1000U, 3000U}) {
    bus::MemoryBus wire;
    test::StutteringPort base(wire.attach(), every_ms), controller(wire.attach(), every_ms);
    const auto over_bus =
        test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep, base, controller);
    EXPECT_EQ(over_bus.result.hash, run(scenario).hash) << every_ms;
    EXPECT_EQ(over_bus.figures.health.stops, 0U) << every_ms;
    EXPECT_GE(over_bus.figures.round_trip_us.back(), 1000 * every_ms / 2) << every_ms;
  }
}

class Twins : public testing::TestWithParam<std::tuple<can::SyncMode, std::uint32_t>> {};

TEST_P(Twins, OfTheControllerEndTheRunWithAFault) {
  const auto [sync_mode, from_ms] = GetParam();
  bus::MemoryBus wire;
  bus::MemoryPort &base = wire.attach(), &controller = wire.attach();
  hil::HostPlanners planners(kDefaultPlanner);
  can_app::Controller twin(wire.attach(), {1, 88, 0}, planners);
  const auto twins_turn = [&twin, from = from_ms](std::uint32_t now_ms) {
    if (now_ms >= from) twin.poll(now_ms);
  };
  const auto over_bus = test::drive_over_bus(scenario_of(worlds::Kind::discs), kDefaultPlanner, sync_mode,
                                             base, controller, {}, twins_turn);
  EXPECT_EQ(over_bus.result.verdict, Verdict::fault);
  EXPECT_EQ(over_bus.result.detail, "duplicate_node");
  EXPECT_EQ(over_bus.result.ticks > 10, from_ms > 0);
}

INSTANTIATE_TEST_SUITE_P(Now, Twins,
                         testing::Combine(testing::Values(can::SyncMode::lockstep, can::SyncMode::real_time),
                                          testing::Values(0U, 1500U)));

INSTANTIATE_TEST_SUITE_P(Worlds, EveryWorld, testing::ValuesIn(worlds::kKinds));

/// A run in lockstep, with ports that drop frames where asked.
auto in_lockstep(const Scenario& scenario, bool base_drops, bool controller_drops) {
  bus::MemoryBus wire;
  test::LossyPort base(wire.attach(), 1), controller(wire.attach(), 2);
  hal::CanPort& plain_base = wire.attach();
  hal::CanPort& plain_controller = wire.attach();
  return test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::lockstep,
                              base_drops ? static_cast<hal::CanPort&>(base) : plain_base,
                              controller_drops ? static_cast<hal::CanPort&>(controller) : plain_controller);
}

TEST(Bus, HandsThePressesOfTheBumperOnAlsoIfFramesAreDropped) {
  const Scenario scenario = test::unseen_disc();
  const RunResult direct = run(scenario);
  EXPECT_EQ(direct.verdict, Verdict::reached);
  EXPECT_GE(direct.bumps.value_or(0), 1U);
  for (const bool lossy : {false, true}) {
    const auto over_bus = in_lockstep(scenario, lossy, false);
    EXPECT_EQ(over_bus.result.hash, direct.hash);
    EXPECT_EQ(over_bus.result.bumps, direct.bumps);
  }
}

/// A gyro like that of host/robots/gyro.toml.
Scenario with_gyro(worlds::Kind kind) {
  Scenario s = scenario_of(kind);
  s.robot.gyro.fitted = Fitted::yes;
  s.noise.wheel_scale_sigma = 0.01;
  s.noise.gyro_bias_dps = 1;
  s.noise.gyro_walk_deg_per_sqrt_h = 0.4;
  s.noise.gyro_scale_sigma = 0.001;
  return s;
}

/// Wheels that are worse than the robot declares, so that some fixes are jumps.
Scenario with_fixes(JumpPolicy policy) {
  Scenario s = scenario_of(worlds::Kind::discs);
  s.noise.wheel_scale_sigma = 0.03;
  s.robot.pose_error.wheel_scale = millionths(3000);
  s.robot.fix_jumps = policy;
  s.noise.fix_every_m = 0.5;
  s.noise.fix_sigma_m = 0.01;
  s.noise.fix_sigma_deg = 0.5;
  return s;
}

TEST(Bus, HandsTheGyroOnAlsoIfFramesAreDropped) {
  for (const worlds::Kind kind : {worlds::Kind::discs, worlds::Kind::maze}) {
    const Scenario scenario = with_gyro(kind);
    const RunResult direct = run(scenario);
    Scenario without = scenario;
    without.robot.gyro.fitted = Fitted::no;
    EXPECT_NE(run(without).hash, direct.hash) << "the gyro changes the run";
    for (const bool lossy : {false, true}) {
      const auto over_bus = in_lockstep(scenario, lossy, lossy);
      EXPECT_EQ(over_bus.result.hash, direct.hash) << lossy;
      EXPECT_EQ(over_bus.result.ticks, direct.ticks) << lossy;
      EXPECT_EQ(over_bus.result.believed_distance_m, std::nullopt) << "only the controller knows it";
    }
  }
}

TEST(Bus, HandsTheGyroOnInRealTime) {
  const Scenario scenario = with_gyro(worlds::Kind::discs);
  bus::MemoryBus wire;
  const auto over_bus =
      test::drive_over_bus(scenario, kDefaultPlanner, can::SyncMode::real_time, wire.attach(), wire.attach());
  EXPECT_EQ(over_bus.figures.misses, 0U);
  EXPECT_EQ(over_bus.result.hash, run(scenario).hash);
}

TEST(Bus, HandsFixesOnAndTheirAnswersBack) {
  for (const JumpPolicy policy : {JumpPolicy::accept, JumpPolicy::refuse}) {
    const Scenario scenario = with_fixes(policy);
    const RunResult direct = run(scenario);
    for (const bool lossy : {false, true}) {
      const auto over_bus = in_lockstep(scenario, lossy, false);
      EXPECT_EQ(over_bus.result.hash, direct.hash) << lossy;
      const hil::Figures& f = over_bus.figures;
      EXPECT_GT(f.fixes, 5U);
      EXPECT_EQ(f.fixes_accepted + f.fixes_refused, f.fixes) << lossy;
      EXPECT_EQ(f.fixes_refused > 0, policy == JumpPolicy::refuse) << lossy;
    }
  }
}

// Many random faults at once: no contact is due to the bus, the wheels brake whenever the robot does not run,
// and every frame is accounted for.

/// Faults of every kind at random times, each for a while.
bus::Schedule random_faults(std::uint64_t seed, std::uint32_t ticks) {
  worlds::Random random(seed);
  bus::Schedule schedule;
  for (std::uint32_t from = 60; from < ticks; from += 60 + static_cast<std::uint32_t>(random.index(500))) {
    bus::Fault f{};
    // A forged frame passes all checks.
    do f.kind = static_cast<bus::FaultKind>(random.index(static_cast<int>(bus::kFaultKinds)));
    while (f.kind == bus::FaultKind::forge);
    f.from_tick = from;
    f.to_tick = from + 1 + static_cast<std::uint32_t>(random.index(12));
    f.direction = static_cast<bus::Direction>(random.index(3));
    f.chance = random.chance(0.5) ? 1.0 : 0.2;
    f.length = 1 + static_cast<std::uint32_t>(random.index(20));
    f.ticks = 1 + static_cast<std::uint32_t>(random.index(8));
    f.jitter = static_cast<std::uint32_t>(random.index(4));
    f.id = random.chance(0.5) ? 0x000 : 0x101;
    schedule.push_back(f);
  }
  return schedule;
}

void expect_accounts(const can::BusHealth& h, const hal::CanCounts& port, const char* who) {
  EXPECT_EQ(h.accepted + h.foreign + h.malformed + h.crc + h.repeated + h.out_of_sequence + h.out_of_range +
                h.unmatched + h.duplicates + h.e_stops + h.unknown,
            port.received)
      << who;
}

int speed_of(const hal::WheelSpeeds& s) { return std::max(std::abs(s.left), std::abs(s.right)); }

/// Returns the frames that both nodes received.
std::uint64_t soak(std::uint64_t seed, std::uint32_t ticks) {
  worlds::Options options;
  options.seed = seed;
  const Scenario scenario =
      worlds::generate(seed % 2 == 0 ? worlds::Kind::discs : worlds::Kind::rooms, options);
  hil::HostPlanners planners(PlannerKind::boundary);
  test::Rig rig(scenario, random_faults(seed * 2, ticks), random_faults(seed * 2 + 1, ticks), seed,
                &planners);
  rig.drive(20);
  rig.give(can::Order::start);
  for (std::uint32_t t = 20; t < ticks && !testing::Test::HasFailure(); ++t) {
    const hal::WheelSpeeds before = rig.now().speeds;
    rig.drive(1);
    EXPECT_FALSE(rig.plant().in_contact()) << "seed " << seed << " tick " << t;
    if (rig.now().base != can::NodeState::running) {
      EXPECT_LE(speed_of(rig.now().speeds), std::max(speed_of(before) - 100, 0))
          << "seed " << seed << " tick " << t;
    }
    const bool latched =
        rig.now().base == can::NodeState::safe_stop || rig.now().base == can::NodeState::ready;
    if (latched && rig.base().order_state() != can::OrderState::waiting) rig.give(can::Order::resume);
  }
  expect_accounts(rig.base().health(), rig.base_port().counts(), "base");
  expect_accounts(rig.controller().health(), rig.controller_port().counts(), "controller");
  EXPECT_GT(rig.base().health().stops, 0U);
  return rig.base_port().counts().received + rig.controller_port().counts().received;
}

TEST(Soak, RandomFaultsCauseNoContactAndNoMissedStop) {
  const std::uint64_t wanted = test::effort(16667, 1000000);
  std::uint64_t frames = 0;
  for (std::uint64_t seed = 1; frames < wanted && !HasFailure(); ++seed) frames += soak(seed, 4000);
  RecordProperty("frames", std::to_string(frames));
}

}  // namespace
}  // namespace whisker
