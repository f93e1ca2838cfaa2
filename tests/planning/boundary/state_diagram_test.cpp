// The state diagrams of docs/phases.md match the code's tables, and the tables are complete and consistent.
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "firmware/planning/arrows.hpp"
#include "firmware/planning/boundary/boundary_planner.hpp"

namespace whisker::planning {
namespace {

const char* name(BoundaryPlanner::Phase phase) {
  switch (phase) {
    case BoundaryPlanner::Phase::survey: return "survey";
    case BoundaryPlanner::Phase::approach: return "approach";
    case BoundaryPlanner::Phase::choose_side: return "choose_side";
    case BoundaryPlanner::Phase::boundary: return "boundary";
    case BoundaryPlanner::Phase::evade: return "evade";
    case BoundaryPlanner::Phase::gap: return "gap";
    case BoundaryPlanner::Phase::arrive: return "arrive";
    case BoundaryPlanner::Phase::over: return "over";
  }
  return nullptr;
}

const char* name(BoundaryPlanner::Event event) {
  switch (event) {
    case BoundaryPlanner::Event::surveyed: return "both sides are faced";
    case BoundaryPlanner::Event::blocked: return "no heading towards the goal is left";
    case BoundaryPlanner::Event::exit: return "the side is chosen";
    case BoundaryPlanner::Event::no_exit: return "no side has an exit";
    case BoundaryPlanner::Event::nearer: return "the leave rule holds";
    case BoundaryPlanner::Event::closed: return "the loop is closed once, the other way round";
    case BoundaryPlanner::Event::wall_lost: return "the loop is of another obstacle";
    case BoundaryPlanner::Event::doubted: return "the map is doubted";
    case BoundaryPlanner::Event::enclosed: return "the loop is closed both ways round";
    case BoundaryPlanner::Event::refuted: return "the last try with the map found no way either";
    case BoundaryPlanner::Event::stuck: return "no way is left";
    case BoundaryPlanner::Event::threatened: return "something that moves comes this way";
    case BoundaryPlanner::Event::passed: return "it has passed";
    case BoundaryPlanner::Event::slit: return "the boundary may have a narrow gap";
    case BoundaryPlanner::Event::through: return "through the gap";
    case BoundaryPlanner::Event::no_door: return "the gap straight ahead is too narrow";
    case BoundaryPlanner::Event::too_narrow: return "the gap is too narrow";
    case BoundaryPlanner::Event::at_goal: return "at the goal";
    case BoundaryPlanner::Event::slid_off: return "at rest beside the goal";
    case BoundaryPlanner::Event::settled: return "at rest at the goal";
  }
  return nullptr;
}

const char* name(Approach::Phase phase) {
  switch (phase) {
    case Approach::Phase::drive: return "drive";
    case Approach::Phase::scan: return "scan";
    case Approach::Phase::brake: return "brake";
  }
  return nullptr;
}

const char* name(Approach::Event event) {
  switch (event) {
    case Approach::Event::unknown: return "the guard holds it before unknown ground";
    case Approach::Event::scanned: return "scanned";
    case Approach::Event::refused: return "the advised way is blocked";
    case Approach::Event::settled: return "at rest";
  }
  return nullptr;
}

const char* name(BoundaryFollower::Phase phase) {
  switch (phase) {
    case BoundaryFollower::Phase::brake: return "brake";
    case BoundaryFollower::Phase::search: return "search";
    case BoundaryFollower::Phase::scan: return "scan";
    case BoundaryFollower::Phase::turn: return "turn";
    case BoundaryFollower::Phase::follow: return "follow";
    case BoundaryFollower::Phase::retreat: return "retreat";
  }
  return nullptr;
}

const char* name(BoundaryFollower::Event event) {
  switch (event) {
    case BoundaryFollower::Event::settled: return "at rest";
    case BoundaryFollower::Event::unknown: return "the next heading is unknown";
    case BoundaryFollower::Event::scanned: return "scanned";
    case BoundaryFollower::Event::free: return "a heading is free";
    case BoundaryFollower::Event::none_free: return "no heading is free";
    case BoundaryFollower::Event::facing: return "faced";
    case BoundaryFollower::Event::opening: return "the wall may have an opening";
    case BoundaryFollower::Event::stuck: return "held by the guard";
    case BoundaryFollower::Event::back: return "a bit back";
  }
  return nullptr;
}

/// A state machine and its table; its phases are Phase(0), Phase(1) ..., its events Event(0) ...
template <class Machine>
struct Diagram {
  using Phase = typename Machine::Phase;
  using Event = typename Machine::Event;

  template <class Enum>
  static std::set<Enum> all() {
    std::set<Enum> found;
    for (int i = 0; name(static_cast<Enum>(i)) != nullptr; ++i) found.insert(static_cast<Enum>(i));
    return found;
  }

  static std::set<Phase> reached(std::set<Phase> from) {
    for (std::size_t before = 0; before != from.size();) {
      before = from.size();
      for (const auto& row : Machine::kTransitions) {
        if (from.count(row.from) > 0) from.insert(row.to);
      }
    }
    return from;
  }

  static void expect_sound(const std::set<Phase>& entries, const std::set<Phase>& ends) {
    std::set<std::pair<Phase, Event>> rows;
    std::set<Event> events;
    std::set<Phase> left;
    for (const auto& row : Machine::kTransitions) {
      EXPECT_TRUE(rows.insert({row.from, row.on}).second)
          << "two arrows of " << name(row.on) << " from " << name(row.from);
      events.insert(row.on);
      left.insert(row.from);
    }
    EXPECT_EQ(events, all<Event>()) << "an event without an arrow";
    EXPECT_EQ(reached(entries), all<Phase>()) << "a phase that is never entered";
    for (const Phase phase : all<Phase>()) {
      EXPECT_NE(left.count(phase), ends.count(phase)) << name(phase);
    }
  }

  static std::string mermaid(const std::set<Phase>& entries, const std::set<Phase>& ends) {
    std::ostringstream out;
    out << "```mermaid\nstateDiagram-v2\n";
    for (const Phase phase : entries) out << "  [*] --> " << name(phase) << '\n';
    for (const auto& row : Machine::kTransitions) {
      out << "  " << name(row.from) << " --> " << name(row.to) << ": " << name(row.on) << '\n';
    }
    for (const Phase phase : ends) out << "  " << name(phase) << " --> [*]\n";
    out << "```\n";
    return out.str();
  }
};

using PlannerDiagram = Diagram<BoundaryPlanner>;
using ApproachDiagram = Diagram<Approach>;
using FollowerDiagram = Diagram<BoundaryFollower>;

const std::set<BoundaryPlanner::Phase> kPlannerEntries{BoundaryPlanner::Phase::survey};
const std::set<BoundaryPlanner::Phase> kPlannerEnds{BoundaryPlanner::Phase::over};
const std::set<Approach::Phase> kApproachEntries{Approach::Phase::drive};
const std::set<BoundaryFollower::Phase> kFollowerEntries{BoundaryFollower::Phase::turn,
                                                         BoundaryFollower::Phase::brake};

TEST(StateDiagram, TablesAreSound) {
  PlannerDiagram::expect_sound(kPlannerEntries, kPlannerEnds);
  ApproachDiagram::expect_sound(kApproachEntries, {});
  FollowerDiagram::expect_sound(kFollowerEntries, {});
}

TEST(StateDiagram, StopsTheTestsAtAnEventWithoutAnArrow) {
  BoundaryFollower::Phase phase = BoundaryFollower::Phase::turn;
  Decision decision;
  decision.mode = Mode::following;
#ifdef WHISKER_ASSERTS
  EXPECT_DEATH(change(BoundaryFollower::kTransitions, BoundaryFollower::Event::opening, phase, decision),
               "knows_the_event");
#else
  change(BoundaryFollower::kTransitions, BoundaryFollower::Event::opening, phase, decision);
#endif
  EXPECT_EQ(phase, BoundaryFollower::Phase::turn);
  EXPECT_EQ(decision.mode, Mode::following);
  change(BoundaryFollower::kTransitions, BoundaryFollower::Event::facing, phase, decision);
  EXPECT_EQ(phase, BoundaryFollower::Phase::follow);
}

TEST(Arrows, StopTheTestsAtAChangeWithoutAnArrow) {
  enum class Phase : uint8_t { off, on };
  static constexpr Arrow<Phase> kArrows[] = {{Phase::off, Phase::on}};
  Phase phase = Phase::off;
  follow(kArrows, phase, Phase::on);
  EXPECT_EQ(phase, Phase::on);
#ifdef WHISKER_ASSERTS
  EXPECT_DEATH(follow(kArrows, phase, Phase::off), "leads");
#endif
}

std::string document() {
  return "# The boundary planner's phases\n\n"
         "Three state machines drive: the planner chooses between the way to the goal (the approach) and "
         "the\n"
         "way round an obstacle (the boundary follower). Each picture is drawn from the table of "
         "transitions\n"
         "in the code; `tests/planning/boundary/state_diagram_test.cpp` draws them and keeps them true. "
         "Which\n"
         "mode and which reason an arrow shows in the trace stands in the same table. What each rule is for "
         "is\n"
         "in [navigation.md](navigation.md#the-boundary-planner).\n\n"
         "## The planner\n\n"
         "`firmware/planning/boundary/boundary_planner.hpp`. Beside these arrows a mission ends from every\n"
         "phase as *gave up* when the length budget is used up, or after 1,000 phases in one place.\n\n" +
         PlannerDiagram::mermaid(kPlannerEntries, kPlannerEnds) +
         "\n## The approach\n\n"
         "`firmware/planning/boundary/approach.hpp`. It runs while the planner is in `approach`. A blocked "
         "way\n"
         "ends it: the planner then chooses a side.\n\n" +
         ApproachDiagram::mermaid(kApproachEntries, {}) +
         "\n## The boundary follower\n\n"
         "`firmware/planning/boundary/boundary_follower.hpp`. It runs while the planner is in `boundary`, "
         "and\n"
         "in the host's Bug2, DistBug and wall follower. It starts with a turn where the side search found "
         "a\n"
         "free heading, and with `brake` otherwise. The leave rule is asked in `follow` only.\n\n" +
         FollowerDiagram::mermaid(kFollowerEntries, {});
}

TEST(StateDiagram, DocumentIsDrawnFromTheTables) {
  const std::string path = std::string(WHISKER_SOURCE_DIR) + "/docs/phases.md";
  if (std::getenv("WHISKER_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << document();
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), document()) << "to update it: WHISKER_UPDATE_GOLDEN=1 and this test";
}

}  // namespace
}  // namespace whisker::planning
