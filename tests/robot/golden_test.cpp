// The decisions of whole runs, compared with committed ones. An intended change of behaviour commits the new
// files: run this program once with WHISKER_UPDATE_GOLDEN=1 in the environment, and read the diff.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "host/report/result.hpp"
#include "host/run/runner.hpp"
#include "host/scenario/load.hpp"
#include "host/worlds/generate.hpp"

namespace whisker {
namespace {

#ifdef WHISKER_ENGINE_CLOSED
constexpr const char* kEngine = "closed";
#else
constexpr const char* kEngine = "table";
#endif

const std::filesystem::path kSource = WHISKER_SOURCE_DIR;

struct Case {
  std::string name;
  Scenario scenario;
};

std::string decisions(const Scenario& scenario) {
  std::vector<TickRecord> records;
  RunOptions options;
  options.planner = PlannerKind::thesis;
  options.records = &records;
  const RunResult result = run(scenario, options);
  std::string text =
      fmt::format("# {} {} ticks {} hash {:016x}\nt_s,x_m,y_m,heading_rad,state,why,t,d,r,sa,sd\n",
                  report::outcome(result.verdict), result.detail, result.ticks, result.hash);
  for (const TickRecord& r : records) {
    if (!r.looked) continue;
    text +=
        fmt::format("{:.2f},{:.4f},{:.4f},{:.4f},{},{},{},{},{},{},{}\n", r.t_s, r.x_m, r.y_m, r.heading_rad,
                    nav::name(r.mode), nav::name(r.why), r.danger_count, r.d_q7, r.r_q7, r.sa_q14, r.sd_q14);
  }
  return text;
}

std::vector<Case> cases() {
  const std::filesystem::path folder = kSource / "host/worlds/scenarios";
  std::vector<Case> all;
  for (const char* name : {"two_discs", "figure8_u_trap", "figure9_discs", "figure10_discs"}) {
    all.push_back({name, load_scenario(folder / (std::string(name) + ".toml"))});
  }
  for (const auto kind :
       {worlds::Kind::discs, worlds::Kind::poles, worlds::Kind::u_trap, worlds::Kind::spiral,
        worlds::Kind::maze, worlds::Kind::rooms, worlds::Kind::enclosed}) {
    worlds::Options options;
    options.seed = 1;
    options.noise = kind == worlds::Kind::discs;
    Scenario s = worlds::generate(kind, options);
    s.time_limit_s = 60;
    all.push_back({fmt::format("{}_1", worlds::name(kind)), s});
  }
  return all;
}

TEST(Golden, EveryDecisionIsTheCommittedOne) {
  const bool update = std::getenv("WHISKER_UPDATE_GOLDEN") != nullptr;
  for (const Case& c : cases()) {
    const std::filesystem::path path = kSource / "tests/robot/golden" / kEngine / (c.name + ".csv");
    const std::string now = decisions(c.scenario);
    if (update) std::ofstream(path) << now;
    std::ifstream file(path);
    std::stringstream committed;
    committed << file.rdbuf();
    EXPECT_EQ(now, committed.str()) << c.name;
  }
  EXPECT_FALSE(update) << "the golden files were written anew; run again without WHISKER_UPDATE_GOLDEN";
}

}  // namespace
}  // namespace whisker
