#include "host/cli/campaign_page.hpp"

#include <utility>

#include "host/cli/rules_choice.hpp"
#include "host/page/page.hpp"
#include "host/report/file.hpp"

namespace whisker::cli {
namespace {

constexpr std::size_t kMostBytes = 5'000'000;  // of all missions to replay, so that the page can be mailed

page::StoredRun driven_again(const Missions& missions, std::uint64_t index) {
  const Scenario scenario = mission(missions, index).scenario;
  page::Recording recording(scenario.robot, page::Detail::coarse);
  RunOptions options;
  options.planner = missions.planner;
  options.watch = [&](const Moment& moment) { recording.add(moment); };
  const RunResult result = run(scenario, options);
  recording.end();
  return page::stored({scenario, options.planner, scenario.seed}, recording.ticks(), result,
                      page::Detail::coarse);
}

}  // namespace

void write_campaign_page(const std::string& path, const Missions& missions,
                         const std::vector<campaign::Row>& rows) {
  std::vector<page::Replay> replays;
  std::size_t bytes = 0;
  for (const std::size_t row : page::worst(rows, rows.size())) {
    page::StoredRun run = driven_again(missions, missions.first + row);
    bytes += run.json.size() + run.columns.size();
    if (bytes > kMostBytes && !replays.empty()) break;
    replays.push_back({row, std::move(run)});
  }
  report::write_file(path, page::campaign_page(rows, replays, controller_picture(missions.planner)));
}

}  // namespace whisker::cli
