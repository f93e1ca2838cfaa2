// In the middle of a ring, a beam shows the same millimetre all around, like one that has stopped measuring.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/effort.hpp"
#include "tests/missions/bench.hpp"

namespace whisker::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr PlannerKind kPlanners[] = {PlannerKind::boundary, PlannerKind::map, PlannerKind::thesis};

enum class Ring { closed, door, posts };

struct Room {
  Ring ring;
  double radius;
  sim::Vec2 start;
  double door_deg = 60;  ///< of its middle
};

std::ostream& operator<<(std::ostream& to, const Room& r) {
  const char* const names[] = {"closed", "door", "posts"};
  return to << names[static_cast<int>(r.ring)] << ", radius " << r.radius << ", from " << r.start.x << ", "
            << r.start.y;
}

Scenario in(const Room& room) {
  Scenario s;
  s.time_limit_s = 600;
  s.start = {room.start, 0.3};
  s.goal.at = {room.radius + 1.5, 0.4};
  const double door = room.ring == Ring::closed ? 0 : 0.5 / room.radius;
  const double from = room.door_deg * kPi / 180 + door / 2, all = 2 * kPi - door;
  const auto at = [&](double share) {
    const double a = from + all * share;
    return sim::Vec2{room.radius * std::cos(a), room.radius * std::sin(a)};
  };
  if (room.ring == Ring::posts) {
    const int n = static_cast<int>(all * room.radius / 0.05);
    for (int i = 0; i <= n; ++i) s.discs.push_back({at(double(i) / n), 0.01});
  } else {
    s.walls.emplace_back();
    for (int i = 0; i <= 144; ++i) s.walls.back().push_back(at(i / 144.0));
  }
  return s;
}

struct Ended {
  std::string how;
  std::uint32_t stuck = 0;      ///< readings that counted as stuck
  std::optional<double> way_m;  ///< from where a frozen beam had turned by 150 degrees, if it had
};

/// `frozen`: this beam repeats its first distance for ever.
Ended drive(const Scenario& s, PlannerKind planner, int frozen = -1) {
  Bench bench(s, planner);
  std::optional<hal::RangeReading> first;
  double since = 0;
  std::optional<sim::Vec2> turned_at;
  bench.board().ranges = [&](hal::RangeReadings& out) {
    if (frozen < 0) return;
    hal::RangeReading& beam = out.beam[frozen];
    if (!first && beam.status == hal::RangeStatus::ok) {
      first = beam;
      since = bench.plant().pose().heading;
    }
    if (first) beam.mm = first->mm, beam.status = first->status;
  };
  Ended ended;
  while (bench.plant().time() < s.time_limit_s && bench.step(10)) {
    const sim::Pose at = bench.plant().pose();
    const bool turned = first && std::abs(std::remainder(at.heading - since, 2 * kPi)) >= 150 * kPi / 180;
    if (turned && !turned_at) turned_at = at.at;
    if (turned_at) ended.way_m = std::hypot(at.at.x - turned_at->x, at.at.y - turned_at->y);
  }
  ended.how = bench.ended();
  ended.stuck = bench.status().health.range_stuck;
  return ended;
}

std::vector<Room> rooms(Ring ring) {
  std::vector<Room> all;
  for (const double radius : {0.3, 1.0, 1.7}) {
    for (const double off : {0.0, 0.0007, 0.005}) all.push_back({ring, radius, {off, off / 2}});
  }
  return all;
}

TEST(RoundRoom, AHealthySensorIsNotStuck) {
  for (const Ring ring : {Ring::closed, Ring::door, Ring::posts}) {
    for (const Room& room : rooms(ring)) {
      for (const PlannerKind planner : kPlanners) {
        Scenario s = in(room);
        if (planner == PlannerKind::thesis) s.time_limit_s = 30;  // it knows no loops
        const Ended e = drive(s, planner);
        EXPECT_EQ(e.stuck, 0U) << room << ", " << name(planner) << ": " << e.how;
        if (planner == PlannerKind::thesis) continue;
        EXPECT_EQ(e.how, ring == Ring::closed ? "unreachable" : "reached") << room << ", " << name(planner);
      }
    }
  }
}

// Found once the body has turned by 150 degrees and then moved; until then it is as good as any reading.
TEST(RoundRoom, AFrozenSensorIsFound) {
  int turned = 0;
  for (const Ring ring : {Ring::closed, Ring::door, Ring::posts}) {
    for (const Room& room : rooms(ring)) {
      for (const PlannerKind planner : kPlanners) {
        Scenario s = in(room);
        s.time_limit_s = 40;
        const int beam = turned % hal::kBeams;
        const Ended e = drive(s, planner, beam);
        if (!e.way_m) continue;
        ++turned;
        // The thesis's planner may only turn in a closed room.
        const bool moved = *e.way_m > 0.05 || planner != PlannerKind::thesis;
        EXPECT_TRUE(!moved || e.how == "range_lost" || e.how == "range_untrusted")
            << room << ", " << name(planner) << ", beam " << beam << ": " << e.how;
        EXPECT_LT(*e.way_m, 0.2) << room << ", " << name(planner) << ", beam " << beam;
      }
    }
  }
  EXPECT_GE(turned, 40);
}

/// Both walls of a corridor keep their distance over any way.
TEST(Corridor, AHealthySensorIsNotStuck) {
  for (const PlannerKind planner : kPlanners) {
    Scenario s;
    s.start.heading = kPi;  // away from the goal
    s.goal.at = {4, 0};
    s.walls = {{{-1, 0.3}, {5, 0.3}}, {{-1, -0.3}, {5, -0.3}}};
    const Ended e = drive(s, planner);
    EXPECT_EQ(e.how, "reached") << name(planner);
    EXPECT_EQ(e.stuck, 0U) << name(planner);
  }
}

}  // namespace
}  // namespace whisker::test
