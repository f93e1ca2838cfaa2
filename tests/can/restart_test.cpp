// A controller that starts anew has the default parameters. Whenever it does, the robot must not drive with
// them.
#include <gtest/gtest.h>

#include <memory>

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

/// The hash of the run; 0: the base noticed, and the run begins again.
std::uint64_t hash_with_a_restart_at(std::uint32_t restart_ms, can::SyncMode sync_mode) {
  bus::MemoryBus wire;
  hal::CanPort& base = wire.attach();
  hal::CanPort& port = wire.attach();
  // Lost frames make each step of the beginning longer; in real time they would change the way.
  test::LossyPort lossy_base(base, restart_ms), lossy_port(port, restart_ms + 1);
  hil::HostPlanners planners(kDefaultPlanner);
  const bool lockstep = sync_mode == can::SyncMode::lockstep;
  hal::CanPort& controllers = lockstep ? static_cast<hal::CanPort&>(lossy_port) : port;
  auto controller = std::make_unique<can_app::Controller>(controllers, can::Identity{1, 77, 0}, planners);
  test::SharedTime time([&](std::uint32_t now_ms) {
    if (now_ms == restart_ms)
      controller = std::make_unique<can_app::Controller>(controllers, can::Identity{1, 78, 0}, planners);
    controller->poll(now_ms);
  });
  hil::Figures figures;
  hil::BusOptions bus;
  bus.sync_mode = sync_mode;
  bus.resend_ms = 3;
  RunOptions options;
  options.pilot =
      hil::bus_pilot(lockstep ? static_cast<hal::CanPort&>(lossy_base) : base, time, bus, figures);
  try {
    return run(of_a_larger_robot(), options).hash;
  } catch (const hil::ControllerRestarted&) {
    return 0;
  }
}

TEST(Restart, AtAnyMillisecondNeverDrivesWithTheDefaultParameters) {
  const std::uint64_t hash = run(of_a_larger_robot()).hash;
  for (const can::SyncMode sync_mode : {can::SyncMode::lockstep, can::SyncMode::real_time}) {
    int noticed = 0;
    for (std::uint32_t ms = 1; ms <= 150; ++ms) {
      const std::uint64_t got = hash_with_a_restart_at(ms, sync_mode);
      noticed += got == 0 ? 1 : 0;
      EXPECT_TRUE(got == 0 || got == hash) << "restarted at " << ms << " ms";
    }
    EXPECT_GT(noticed, 90);
  }
}

}  // namespace
}  // namespace whisker
