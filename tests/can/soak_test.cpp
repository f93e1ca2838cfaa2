// Many random faults at once: no contact is due to the bus, the wheels brake whenever the robot does not run,
// and every frame is accounted for.
#include <algorithm>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "host/hil/planners.hpp"
#include "host/worlds/generate.hpp"
#include "host/worlds/random.hpp"
#include "tests/can/rig.hpp"
#include "tests/effort.hpp"

namespace whisker {
namespace {

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
  hil::HostPlanners planners(PlannerKind::skirt);
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
