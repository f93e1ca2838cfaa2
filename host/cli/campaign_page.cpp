#include "host/cli/campaign_page.hpp"

#include "host/cli/controller_picture.hpp"
#include "host/page/page.hpp"
#include "host/report/file.hpp"

namespace whisker::cli {
namespace {

constexpr std::size_t kReplays = 8;

page::StoredRun driven_again(const Missions& missions, std::uint64_t index) {
  const Scenario scenario = mission(missions, index).scenario;
  page::Recording recording(scenario.robot);
  RunOptions options;
  options.planner = missions.planner;
  options.watch = [&](const Moment& moment) { recording.add(moment); };
  const RunResult result = run(scenario, options);
  return page::stored({scenario, options.planner, scenario.seed}, recording.ticks(), result);
}

}  // namespace

void write_campaign_page(const std::string& path, const Missions& missions,
                         const std::vector<campaign::Row>& rows) {
  std::vector<page::Replay> replays;
  for (const std::size_t row : page::worst(rows, kReplays)) {
    replays.push_back({row, driven_again(missions, missions.first + row)});
  }
  report::write_file(path, page::campaign_page(rows, replays, controller_picture()));
}

}  // namespace whisker::cli
