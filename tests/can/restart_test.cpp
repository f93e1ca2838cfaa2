// A controller that starts anew has the default parameters. Whenever it does, the robot must not drive with
// them.
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "host/worlds/generate.hpp"
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

}  // namespace
}  // namespace whisker
