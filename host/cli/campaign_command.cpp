#include <algorithm>
#include <atomic>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/campaign_options.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/one_run.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/file/file.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/write.hpp"
#include "host/lab/campaign/failures.hpp"
#include "host/lab/campaign/mission.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/campaign/row.hpp"
#include "host/lab/campaign/row_file.hpp"
#include "host/lab/campaign/summary.hpp"
#include "host/lab/page/page.hpp"

namespace whisker::cli {
namespace {

constexpr std::size_t kMostBytes = 5'000'000;  // of all missions to replay, so that the page can be mailed

page::StoredRun driven_again(const Missions& missions, std::uint64_t index) {
  const Scenario scenario = mission(missions, index).scenario;
  RunLog log({scenario, missions.planner, scenario.seed}, Detail::coarse);
  RunOptions options;
  options.planner = missions.planner;
  log.watch(options);
  log.end(run(scenario, options));
  return page::stored(log);
}

/// Runs missions again to record them, the worst first and as many as a page holds, and writes a page of all.
/// rows[i] is mission first + i.
void write_campaign_page(const std::string& path, const Missions& missions,
                         const std::vector<campaign::Row>& rows) {
  std::vector<page::Replay> replays;
  std::size_t bytes = 0;
  ProgressLine line;
  for (const std::size_t row : page::worst(rows, rows.size())) {
    line.show(fmt::format("page: {} replays", replays.size()));
    page::StoredRun run = driven_again(missions, missions.first + row);
    bytes += run.json.size() + run.columns.size();
    if (bytes > kMostBytes && !replays.empty()) break;
    replays.push_back({row, std::move(run)});
  }
  files::write(path, page::campaign_page(rows, replays, controller_picture(missions.planner)));
}

/// chosen: null for rows from files, which state their planner themselves.
Provenance provenance(const CampaignOptions& o, const Missions* chosen) {
  Provenance p;
  if (chosen == nullptr) return p;
  p.planner = name(chosen->planner);
  p.rules_digest = rules_name(chosen->planner);
  if (const auto* generated = std::get_if<campaign::Generated>(&chosen->worlds)) {
    p.seed = generated->first_seed;
    if (generated->random_robots) {
      p.robot_name = "random";
      return p;
    }
    Params robot;
    if (!o.robot.empty()) apply_robot_file(robot, o.robot);
    bend_if_chosen(robot, chosen->planner);
    p.robot_name = robot_name(robot, o.robot, "");
    p.robot_digest = robot_digest(robot);
  } else {
    p.seed = o.seed;
    p.robot_name = o.robot.empty() ? "as each scenario has it" : o.robot;
  }
  return p;
}

/// rows_in: the file of the rows.
void print(const CampaignOptions& o, const std::vector<campaign::Row>& rows, const Missions* chosen,
           const std::string& rows_in = "") {
  if (rows.empty()) return;
  const campaign::Summary summary = campaign::summarize(rows);
  if (o.json) {
    print_object(campaign::summary_json(summary), provenance(o, chosen));
  } else {
    std::FILE* const out = words_beside({o.csv, o.html});
    fmt::print(out, "{}{}", campaign::summary_words(summary), campaign::failure_lines(rows));
    if (!rows_in.empty()) fmt::print(out, "rows: {}\n", rows_in);
  }
}

/// Goes on after the rows of an earlier start; the last of them is driven again, so that rows of another
/// robot, other rules or another version are noticed. rows_in: their file. True if the campaign finished.
bool drive_all(const CampaignOptions& o, Missions missions, std::vector<campaign::Row>& rows,
               std::string& rows_in) {
  if (!o.overwrite && files::has_content(o.csv))
    throw UsageError(fmt::format("--csv {}: is there already; --overwrite replaces it", o.csv));
  std::optional<campaign::RowFile> file;
  if (!o.csv.empty()) file.emplace(o.csv);
  if (file) rows = file->found();
  const auto other = [&](const std::string& what) {
    return InputError(file->part(), rows.size() + 1, 1,
                      fmt::format("{}: name another file, or remove this one", what));
  };
  bool known = !rows.empty();
  if (known) {
    const campaign::Row& last = rows.back();
    if (last.missions != missions.all || last.mission != missions.first + rows.size() ||
        last.mission > missions.last) {
      throw other(fmt::format("mission {} of {} of another campaign", last.mission, last.missions));
    }
    missions.first += rows.size() - 1;
  }
  const bool scaled = has_worlds_of_size(missions);
  const bool whole = drive_many(
      missions, o.jobs,
      [&](const Scenario& scenario, const std::atomic<bool>& stop) {
        const double size = scaled ? campaign::size_of(scenario.robot) : 1;
        return campaign::drive(scenario, missions.planner, stop, campaign::kWayRadius * size);
      },
      [&](const campaign::Row& row) {
        if (std::exchange(known, false)) {
          if (to_csv(row) != to_csv(rows.back())) throw other("this command drives that mission otherwise");
          fmt::print(stderr, "whisker: goes on after the {} missions of {}\n", rows.size(), file->part());
          return;
        }
        if (file) file->add(row);
        rows.push_back(row);
      });
  if (file && whole) file->finish();
  rows_in = file && !file->part().empty() ? file->part() : o.csv;
  return whole;
}

/// `whisker run` on such a file with the same planner repeats the mission.
void save_failures(const std::string& folder, const Missions& chosen,
                   const std::vector<campaign::Row>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!campaign::is_failure(rows[i])) continue;
    const std::string text = to_toml(mission(chosen, chosen.first + i).scenario);
    files::write(folder + "/" + campaign::scenario_file(rows[i]), text);
  }
}

int run_campaign(const CampaignOptions& o) {
  if (!o.merge.empty()) {
    print(o, campaign::merged(o.merge, o.incomplete), nullptr);
    return 0;
  }
  if (o.worlds.empty()) throw UsageError("KIND|DIR is required");
  check_outputs({o.csv, o.svg, o.trace, o.html}, {o.robot}, o.json);
  const Missions chosen = missions(o);
  if (o.replay) {
    RunOptions options;
    options.planner = chosen.planner;
    const Scenario scenario = mission(chosen, 0).scenario;
    const RunOutputs outputs{o.trace, o.svg, o.html, o.json,
                             o.robots.empty() ? robot_name(scenario.robot, o.robot, o.worlds)
                                              : campaign::random_robot_name(*o.replay)};
    return drive_one(scenario, options, outputs);
  }
  if (!o.svg.empty() || !o.trace.empty()) throw UsageError("--svg and --trace need --replay");
  if (!o.save_failures.empty() && !std::filesystem::is_directory(o.save_failures)) {
    throw UsageError(fmt::format("--save-failures {}: no such folder", o.save_failures));
  }
  std::vector<campaign::Row> rows;
  std::string rows_in;
  const bool whole = drive_all(o, chosen, rows, rows_in);
  print(o, rows, &chosen, rows_in);
  if (!o.save_failures.empty()) save_failures(o.save_failures, chosen, rows);
  if (whole && !o.html.empty()) {
    write_campaign_page(o.html, chosen, rows);
    if (!o.json) fmt::print(words_beside({o.csv, o.html}), "page: {}\n", o.html);
  }
  if (whole) return 0;
  throw Interrupted(fmt::format(" after {} of {} missions{}", rows.size(), chosen.last - chosen.first,
                                rows_in == o.csv ? "" : "; the same command goes on"));
}

/// CLI11's own exclusions would lengthen the help text.
void refuse_others(const CLI::App& command, std::initializer_list<std::string> allowed) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    throw UsageError(fmt::format("{} does not go with {}", name, *allowed.begin()));
  }
}

int scan(const CampaignOptions& o) {
  if (o.worlds.empty()) throw UsageError("KIND|DIR is required");
  const Missions chosen = missions(o);
  std::vector<campaign::Row> rows;
  const bool whole = drive_many(
      chosen, o.jobs, [](const Scenario& s, const std::atomic<bool>&) { return campaign::scan(s); },
      [&](const campaign::Row& row) { rows.push_back(row); });
  if (!rows.empty()) {
    const campaign::Summary summary = campaign::summarize(rows);
    if (o.json) {
      print_object(campaign::scan_json(summary), {o.seed});
    } else {
      fmt::print("{}", campaign::scan_words(summary));
    }
  }
  if (whole) return 0;
  throw Interrupted(fmt::format(" after {} of {} worlds", rows.size(), chosen.last - chosen.first));
}

}  // namespace

void add_campaign(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("campaign", "Drive many missions and sum them up");
  const auto o = std::make_shared<CampaignOptions>();
  add_worlds(*cmd, *o, "missions");
  add_switch(*cmd, "--noise", o->world.noise, "Sensor noise and odometry error, as in `whisker world`");
  add_wheel_scale_sigma(*cmd, o->world.wheel_scale_sigma, "Scale error of the wheels, as in `whisker world`");
  add_planner(*cmd, o->planner);
  add_file(*cmd, "--robot", o->robot, "Parameters of your robot (TOML), over those of the scenarios");
  add_switch(*cmd, "--to-size", o->to_size,
             "With --robot: each world scaled to its body,\nand no tolerance below that of the world");
  add_name(*cmd, "--robots", o->robots, "Each seed draws a robot, in a world of its size")
      ->type_name("random");
  add_jobs(*cmd, *o);
  cmd->add_option("--shard", o->shard, "Only the I-th of N parts of the missions")->type_name("I/N");
  add_file(*cmd, "--csv", o->csv, "Write one row per mission");
  add_name(*cmd, "--save-failures", o->save_failures, "Write the scenario of each failed mission there")
      ->type_name("FOLDER");
  add_switch(*cmd, "--scanner", o->scanner,
             "A yardstick, no planner: how far a robot drives that sees all round");
  add_switch(*cmd, "--json", o->json, "Print the summary as one JSON object and nothing else");
  add_switch(*cmd, "--overwrite", o->overwrite, "Replace the file of --csv, which is complete");
  cmd->add_option("--merge", o->merge, "Sum up the rows of these files instead of driving")
      ->type_name("FILE");
  add_switch(*cmd, "--incomplete", o->incomplete, "With --merge: missions of a campaign may be missing");
  whole_number(
      cmd->add_option("--replay", o->replay, "Drive the mission with this seed alone, as `whisker run` does"),
      "S");
  add_file(*cmd, "--svg", o->svg, "With --replay: draw the run");
  add_file(*cmd, "--trace", o->trace, "With --replay: write one CSV row per control tick");
  add_file(*cmd, "--html", o->html, "Write a page: the missions, and their replays");
  cmd->callback([o, cmd, &status] {
    if (!o->merge.empty()) refuse_others(*cmd, {"--merge", "--incomplete", "--json"});
    if (o->replay) {
      refuse_others(*cmd, {"--replay", "KIND|DIR", "--discs", "--width", "--box", "--noise",
                           "--wheel-scale-sigma", "--planner", "--map-bytes", "--rules", "--map", "--robot",
                           "--robots", "--to-size", "--svg", "--trace", "--html", "--json"});
    }
    if (o->scanner) {
      refuse_others(*cmd, {"--scanner", "KIND|DIR", "--discs", "--width", "--box", "--count", "--seed",
                           "--jobs", "--json"});
    }
    status = o->scanner ? scan(*o) : run_campaign(*o);
  });
}

}  // namespace whisker::cli
