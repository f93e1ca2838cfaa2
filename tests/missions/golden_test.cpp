// The decisions of whole runs, compared with committed ones. After an intended change of behaviour, run this
// program once with WHISKER_UPDATE_GOLDEN=1 in the environment, and read the diff (docs/development.md).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "firmware/math/crc32.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/meeting.hpp"
#include "host/lab/report/result.hpp"

namespace whisker {
namespace {

const std::filesystem::path kSource = WHISKER_SOURCE_DIR;

struct Case {
  std::string name;
  Scenario scenario;
};

/// For the thesis planner, the ticks with a decision count; for the boundary planner, the ticks in which
/// state or reason change, and one per second.
bool tells(PlannerKind planner, const TickRecord& before, const TickRecord& r, std::size_t tick) {
  if (planner == PlannerKind::thesis) return r.looked;
  return r.mode != before.mode || r.why != before.why || tick % 100 == 0;
}

std::string decisions(const Scenario& scenario, PlannerKind planner) {
  std::vector<TickRecord> records;
  RunOptions options;
  options.planner = planner;
  options.watch = [&](const Moment& moment) { records.push_back(moment.record); };
  const RunResult result = run(scenario, options);
  std::string text =
      fmt::format("# {} {} ticks {} hash {:016x}\nt_s,x_m,y_m,heading_rad,state,why,t,d,r,sa,sd\n",
                  report::outcome(result.verdict), result.detail, result.ticks, result.hash);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TickRecord& r = records[i];
    if (!tells(planner, records[i > 0 ? i - 1 : 0], r, i)) continue;
    text += fmt::format("{:.2f},{:.4f},{:.4f},{:.4f},{},{},{},{},{},{},{}\n", r.t_s, r.x_m, r.y_m,
                        r.heading_rad, planning::name(r.mode), planning::name(r.why), r.danger_count, r.d_q7,
                        r.r_q7, r.sa_q14, r.sd_q14);
  }
  return text;
}

Scenario shipped(const std::string& name) {
  return load_scenario(kSource / "host/worlds/scenarios" / (name + ".toml"));
}

Case generated(worlds::Kind kind) {
  worlds::Options options;
  options.seed = 1;
  options.noise = kind == worlds::Kind::discs;
  Scenario s = worlds::generate(kind, options);
  s.time_limit_s = 60;
  return {fmt::format("{}_1", worlds::name(kind)), s};
}

/// The decisions of these are committed as they are, to be read; of the others, their number and their
/// CRC-32.
constexpr const char* kWhole[] = {"two_discs", "boundary_figure8_u_trap", "boundary_crossing_1"};

/// "NAME: reached at_goal ticks T hash H; N decisions, CRC".
std::string summary(const std::string& name, const std::string& decisions) {
  Crc32 crc;
  for (const char c : decisions) crc.add(static_cast<std::uint8_t>(c));
  return fmt::format("{}: {}; {} decisions, {:08x}\n", name, decisions.substr(2, decisions.find('\n') - 2),
                     std::count(decisions.begin(), decisions.end(), '\n') - 2, crc.value());
}

void expect_committed(const std::string& file, const std::string& now) {
  const bool update = std::getenv("WHISKER_UPDATE_GOLDEN") != nullptr;
  const std::filesystem::path path = kSource / "tests/missions/golden" / file;
  if (update) std::ofstream(path) << now;
  std::ifstream stream(path);
  std::stringstream committed;
  committed << stream.rdbuf();
  EXPECT_EQ(now, committed.str()) << file;
  EXPECT_FALSE(update) << "written anew; run again without WHISKER_UPDATE_GOLDEN";
}

void compare(PlannerKind planner, const std::string& prefix, const std::vector<Case>& cases) {
  std::string summaries;
  for (const Case& c : cases) {
    const std::string name = prefix + c.name, text = decisions(c.scenario, planner);
    if (std::find(std::begin(kWhole), std::end(kWhole), name) != std::end(kWhole)) {
      expect_committed(name + ".csv", text);
    } else {
      summaries += summary(name, text);
    }
  }
  expect_committed(prefix + "others.txt", summaries);
}

TEST(Golden, EveryDecisionOfTheThesisPlannerIsTheCommittedOne) {
  std::vector<Case> cases;
  for (const char* name : {"two_discs", "figure8_u_trap", "figure9_discs", "figure10_discs"}) {
    cases.push_back({name, shipped(name)});
  }
  for (const worlds::Kind kind :
       {worlds::Kind::discs, worlds::Kind::poles, worlds::Kind::u_trap, worlds::Kind::spiral,
        worlds::Kind::maze, worlds::Kind::rooms, worlds::Kind::enclosed}) {
    cases.push_back(generated(kind));
  }
  compare(PlannerKind::thesis, "", cases);
}

TEST(Golden, EveryDecisionOfTheBoundaryPlannerIsTheCommittedOne) {
  compare(
      PlannerKind::boundary, "boundary_",
      {{"figure8_u_trap", shipped("figure8_u_trap")},
       generated(worlds::Kind::discs),
       generated(worlds::Kind::rooms),
       {"crossing_1", worlds::meeting(worlds::Course::crossing, 0.1, 1,
                                      [](const Scenario&, double along_m) { return along_m / 0.3 + 2.5; })}});
}

}  // namespace
}  // namespace whisker
