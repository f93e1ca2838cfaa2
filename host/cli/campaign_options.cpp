#include "host/cli/campaign_options.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/lab/campaign/ordered.hpp"
#include "host/lab/campaign/random_robot.hpp"

namespace whisker::cli {
namespace {

constexpr std::uint64_t kUsualCount = 100;
constexpr std::uint64_t kMostMissions = 1000000000;

campaign::Generated generated(const CampaignOptions& o, worlds::Kind kind) {
  return {kind, o.world, o.replay.value_or(o.seed.value_or(1)), !o.robots.empty()};
}

campaign::Files folder(const CampaignOptions& o) {
  std::error_code error;
  if (!std::filesystem::is_directory(o.worlds, error)) {
    std::vector<std::string_view> kinds;
    for (const worlds::Kind kind : worlds::kAllKinds) kinds.emplace_back(name(kind));
    throw UsageError(fmt::format("{}: neither a kind of world nor a folder of scenario files{}", o.worlds,
                                 did_you_mean(o.worlds, kinds)));
  }
  if (o.world.discs || o.world.gap_m || o.world.box || o.world.noise || o.world.wheel_scale_sigma) {
    throw UsageError(
        "--discs, --width, --box, --noise and --wheel-scale-sigma are for generated worlds; a scenario file "
        "says all that itself");
  }
  if (!o.robots.empty()) throw UsageError("--robots is for generated worlds; scenario files have robots");
  if (o.to_size) throw UsageError("--to-size is for generated worlds; scenario files have a size");
  if (o.replay)
    throw UsageError("--replay is for generated worlds; `whisker run` drives a scenario file again");
  try {
    campaign::Files files = campaign::load_folder(o.worlds, o.robot);
    files.first_seed = o.seed;
    return files;
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

std::uint64_t count(const CampaignOptions& o, const campaign::Generated&) {
  return o.replay ? 1 : o.count.value_or(kUsualCount);
}

std::uint64_t count(const CampaignOptions& o, const campaign::Files& files) {
  const std::uint64_t wanted = o.count.value_or(files.names.size());
  if (wanted > files.names.size() && !o.seed) {
    throw UsageError(
        fmt::format("--count {}: {} has {} scenario files; --seed gives each mission a seed of its own",
                    wanted, o.worlds, files.names.size()));
  }
  return wanted;
}

/// Shard I of N gets the I-th of N blocks, so that the shards' concatenated files are the campaign.
void take_shard(Missions& m, const std::string& shard) {
  if (shard.empty()) return;
  std::uint64_t i = 0, n = 0;
  const char* const end = shard.data() + shard.size();
  const auto first = std::from_chars(shard.data(), end, i);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, n);
  if (second.ec != std::errc{} || second.ptr != end || i < 1 || i > n || n > 1000000) {
    throw UsageError(fmt::format("--shard {}: not of the form I/N with I from 1 to N", shard));
  }
  const std::uint64_t all = m.last;
  m.first = all * (i - 1) / n;
  m.last = all * i / n;
  if (m.first == m.last) throw UsageError(fmt::format("--shard {} of {} missions is empty", shard, all));
}

/// "[#####.....]  512 of 1024, 48.1 a second, 0:11 to go"
std::string progress(std::uint64_t done, std::uint64_t all, double elapsed_s) {
  constexpr std::uint64_t kWidth = 30;
  const auto filled = static_cast<std::size_t>(done * kWidth / all);
  std::string text =
      fmt::format("[{}{}] {} of {}", std::string(filled, '#'), std::string(kWidth - filled, '.'), done, all);
  if (done == 0 || elapsed_s <= 0) return text;
  const double rate = static_cast<double>(done) / elapsed_s;
  const auto left_s = static_cast<std::uint64_t>(static_cast<double>(all - done) / rate + 0.5);
  return text + fmt::format(", {:.1f} a second, {}:{:02} to go", rate, left_s / 60, left_s % 60);
}

int threads(int jobs) {
  if (jobs > 0) return jobs;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

}  // namespace

CLI::Option* add_worlds(CLI::App& app, CampaignOptions& o, const std::string& each, const std::string& name) {
  CLI::Option* worlds =
      app.add_option(name, o.worlds, "A kind of world as in `whisker world`, or a folder of scenario files");
  worlds->type_name("");
  whole_number(app.add_option("--count", o.count,
                              fmt::format("How many {}; 100 by default, or every file once", each)),
               "N", kMostMissions);
  whole_number(app.add_option("--seed", o.seed, "Mission i has seed S + i; 1 by default, or each file's own"),
               "S");
  whole_number(app.add_option("--discs", o.world.discs, "Number of discs, as in `whisker world`"), "N", 200);
  add_gap_width(app, o.world.gap_m, "Of the gap, as in `whisker world`");
  add_switch(app, "--box", o.world.box, "A closed box around, as in `whisker world`");
  return worlds;
}

void add_jobs(CLI::App& app, CampaignOptions& o) {
  whole_number(app.add_option("--jobs", o.jobs, "Missions at a time; as many as there are cores by default"),
               "J", 1024);
}

Missions missions(const CampaignOptions& o) {
  if (!o.robots.empty() && o.robots != "random") {
    throw UsageError(fmt::format("--robots {}: not random", o.robots));
  }
  if (!o.robots.empty() && !o.robot.empty()) throw UsageError("--robots does not go with --robot");
  if (o.to_size && o.robot.empty()) throw UsageError("--to-size needs --robot, whose size it is");
  if (campaign::has_control_characters(o.robot)) {
    throw UsageError("--robot: the file's name has control characters in it");
  }
  Missions m;
  m.planner = o.planner;
  m.robot = o.robot;
  m.to_size = o.to_size;
  if (const auto kind = worlds::kind_named(o.worlds)) {
    m.worlds = generated(o, *kind);
  } else {
    m.worlds = folder(o);
  }
  m.last = std::visit([&](const auto& worlds) { return count(o, worlds); }, m.worlds);
  m.all = m.last;
  check_seeds(m.last, o.seed.value_or(1));
  take_shard(m, o.shard);
  try {
    mission(m, m.first);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
  return m;
}

bool has_random_robots(const Missions& m) {
  const auto* const generated = std::get_if<campaign::Generated>(&m.worlds);
  return generated != nullptr && generated->random_robots;
}

bool has_worlds_of_size(const Missions& m) { return m.to_size || has_random_robots(m); }

campaign::Mission mission(const Missions& m, std::uint64_t index) {
  campaign::Mission mission =
      std::visit([&](const auto& worlds) { return campaign::mission(worlds, index); }, m.worlds);
  const bool generated = std::holds_alternative<campaign::Generated>(m.worlds);
  if (m.to_size) {
    Params robot;
    apply_robot_file(robot, m.robot);
    const double tolerance = mission.scenario.goal.tolerance_m;
    campaign::fit_to(mission.scenario, robot);
    mission.scenario.goal.tolerance_m = std::max(mission.scenario.goal.tolerance_m, tolerance);
    mission.world += campaign::kToSize;
  }
  if (generated && !m.robot.empty()) apply_robot_file(mission.scenario, m.robot);
  bend_if_chosen(mission.scenario.robot, m.planner);
  return mission;
}

std::uint64_t in_parallel(std::uint64_t count, int jobs, const std::function<void(std::uint64_t)>& work) {
  const auto make = [&](std::uint64_t i, const std::atomic<bool>&) {
    work(i);
    return campaign::Row{};
  };
  std::uint64_t done = 0;
  make_many(count, jobs, make, [&](const campaign::Row&) { ++done; });
  return done;
}

void check_seeds(std::uint64_t count, std::uint64_t seed) {
  if (count == 0) throw UsageError("--count 0: nothing to do");
  if (seed > INT64_MAX - count) throw UsageError("--seed and --count: seeds must be below 2^63");
}

bool make_many(std::uint64_t count, int jobs,
               const std::function<campaign::Row(std::uint64_t, const std::atomic<bool>&)>& make,
               const std::function<void(const campaign::Row&)>& take) {
  const Interrupt interrupt;
  ProgressLine line;
  const auto began = std::chrono::steady_clock::now();
  campaign::Work work;
  work.count = count;
  work.jobs = threads(jobs);
  work.make = make;
  work.take = take;
  work.wait = [&](std::uint64_t done) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
    line.show(progress(done, work.count, elapsed.count()));
  };
  work.stop = [&] { return interrupt.noted(); };
  return campaign::do_in_order(work) == work.count;
}

bool drive_many(const Missions& missions, int jobs,
                const std::function<campaign::Row(const Scenario&, const std::atomic<bool>& stop)>& drive,
                const std::function<void(const campaign::Row&)>& take) {
  const auto make = [&](std::uint64_t i, const std::atomic<bool>& stop) {
    const campaign::Mission m = mission(missions, missions.first + i);
    campaign::Row row = drive(m.scenario, stop);
    row.robot = has_random_robots(missions) ? campaign::random_robot_name(m.seed) : missions.robot;
    row.world = m.world;
    row.mission = missions.first + i + 1;
    row.missions = missions.all;
    return row;
  };
  return make_many(missions.last - missions.first, jobs, make, take);
}

}  // namespace whisker::cli
