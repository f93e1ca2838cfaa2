#include <atomic>
#include <memory>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/campaign/scan.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/many_runs.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"

namespace whisker::cli {
namespace {

int scan(const CampaignOptions& o) {
  const Missions chosen = missions(o);
  std::vector<campaign::Row> rows;
  const bool whole = drive_many(
      chosen, o.jobs, [](const Scenario& s, const std::atomic<bool>&) { return campaign::scan(s); },
      [&](const campaign::Row& row) { rows.push_back(row); });
  if (!rows.empty()) {
    const campaign::Summary summary = campaign::summarize(rows);
    if (o.json) {
      Provenance provenance;
      provenance.seed = o.seed;
      fmt::print("{}\n", with_provenance(campaign::scan_json(summary), provenance));
    } else {
      fmt::print("{}", campaign::scan_words(summary));
    }
  }
  if (whole) return 0;
  fmt::print(stderr, "whisker: interrupted after {} of {} worlds\n", rows.size(), chosen.last - chosen.first);
  return kInterrupted;
}

}  // namespace

void add_scanner(CLI::App& app, int& status) {
  CLI::App* cmd =
      app.add_subcommand("scanner", "A yardstick, no planner: how far a robot drives that sees all round");
  const auto o = std::make_shared<CampaignOptions>();
  add_worlds(*cmd, *o, "worlds")->required();
  add_jobs(*cmd, *o);
  add_switch(*cmd, "--json", o->json, "Print the figures as one JSON object and nothing else");
  cmd->callback([o, &status] { status = scan(*o); });
}

}  // namespace whisker::cli
