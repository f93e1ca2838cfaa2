#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/hunt.hpp"
#include "host/lab/hunt/shrink.hpp"
#include "host/lab/hunt/trial.hpp"

namespace whisker::cli {
namespace {

constexpr double kLongestHunt_s = 1e6;
constexpr std::uint64_t kMostProcesses = 1024;
constexpr std::uint64_t kUsualCount = 200;

struct HuntOptions {
  hunt::Options hunt;
  std::string shard, file;
  std::uint64_t jobs = 0;
  std::optional<std::uint64_t> again;
  std::vector<std::string> summary;
};

/// "I/N": every N-th seed from the I-th on.
void take_shard(HuntOptions& o) {
  if (o.shard.empty()) return;
  std::uint64_t i = 0, n = 0;
  const char* const end = o.shard.data() + o.shard.size();
  const auto first = std::from_chars(o.shard.data(), end, i);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, n);
  if (second.ec != std::errc{} || second.ptr != end || i < 1 || i > n) {
    throw UsageError(fmt::format("--shard {}: not of the form I/N with I from 1 to N", o.shard));
  }
  o.hunt.shard = i - 1;
  o.hunt.shards = n;
}

int cores() {
  const unsigned all = std::thread::hardware_concurrency();
  return all > 0 ? static_cast<int>(all) : 1;
}

/// The finding as the hunt tells it; its details if the drive did not end the process.
int show(hunt::Case c) {
  const std::string finding = hunt::finding_of(c);
  if (finding.rfind("crash", 0) != 0) {
    const hunt::Outcome o = hunt::attempt(c);
    fmt::print("{}: {} after {:.2f} s and {:.2f} m; smallest gap {:.6f} m; hash {:016x}\n", hunt::driver(c),
               o.end, o.time_s, o.path_m, o.gap_m, o.hash);
  }
  fmt::print("{}\n", finding.empty() ? "nothing found" : "found: " + finding);
  return finding.empty() ? 0 : kFailure;
}

int again(std::uint64_t seed, const std::string& out) {
  hunt::Drawn drawn = hunt::draw_fresh(seed);
  const std::string kind =
      drawn.c.part.empty() ? fmt::format("family {}, world {}", name(drawn.robot.family), name(drawn.world))
                           : fmt::format("part {}", drawn.c.part);
  fmt::print("seed {}: {}\n", seed, kind);
  hunt::Case c = drawn.c;
  const int status = show(c);
  if (out.empty()) return status;
  hunt::finding_of(c);
  const std::string path = fmt::format("{}/{}-{}", out, hunt::driver(c), seed);
  hunt::save(c, path);
  fmt::print("{}\n", path + ".toml");
  return status;
}

void print_found(const hunt::Row& row, const hunt::Progress& p, const std::string& path) {
  fmt::print("{:.0f} s, {:.0f} s of processor: {}: {} {}, {}, family {}, world {}{}\n", p.elapsed_s,
             p.processor_s, row.finding, row.parent.empty() ? "seed" : "changed",
             row.parent.empty() ? std::to_string(row.seed) : row.parent, row.driver, row.family, row.world,
             path.empty() ? "" : ": " + path + ".toml");
  std::fflush(stdout);
}

int execute(HuntOptions o) {
  if (!o.summary.empty()) {
    fmt::print("{}", hunt::summary(hunt::read_rows(o.summary)));
    return 0;
  }
  if (!o.file.empty()) return show(hunt::load_case(o.file));
  if (!o.hunt.out.empty() && !std::filesystem::is_directory(o.hunt.out)) {
    throw UsageError(fmt::format("--out {}: no such folder", o.hunt.out));
  }
  if (o.again) return again(*o.again, o.hunt.out);
  take_shard(o);
  o.hunt.jobs = o.jobs == 0 ? cores() : static_cast<int>(o.jobs);
  if (o.hunt.count == 0 && o.hunt.time_s == 0) o.hunt.count = kUsualCount;
  const Interrupt interrupt;
  ProgressLine line;
  std::vector<hunt::Row> rows;
  o.hunt.stop = [&] { return interrupt.noted(); };
  o.hunt.show = [&](const hunt::Progress& p, const hunt::Row* row) {
    if (row != nullptr) rows.push_back(*row);
    line.show(fmt::format("{} cases in {:.0f} s, {} findings, corpus {}", p.cases, p.elapsed_s, p.findings,
                          p.corpus));
  };
  o.hunt.found = [&](const hunt::Row& row, const hunt::Progress& p, const std::string& path) {
    line.show("");
    print_found(row, p, path);
  };
  const bool nothing = hunt::hunt(o.hunt);
  line.show("");
  fmt::print("{}", hunt::summary(rows));
  if (interrupt.noted()) throw Interrupted(fmt::format(" after {} cases", rows.size()));
  return nothing ? 0 : kFailure;
}

}  // namespace

void add_hunt(CLI::App& app, int& status) {
  CLI::App* cmd =
      app.add_subcommand("hunt", "Look for drives that break the promise of the guard or of a planner");
  const auto o = std::make_shared<HuntOptions>();
  whole_number(cmd->add_option("--count", o->hunt.count,
                               "Number of fresh cases; 200 by default, without --time all in that time"),
               "N");
  amount(cmd->add_option("--time", o->hunt.time_s,
                         "Ends after this time, s; every second case changes one that came near"),
         "T", kLongestHunt_s);
  whole_number(cmd->add_option("--seed", o->hunt.seed, "Case i is drawn from S + i; 1 by default"), "S");
  whole_number(cmd->add_option("--jobs", o->jobs, "Processes at once; by default one per core"), "J",
               kMostProcesses);
  cmd->add_option("--shard", o->shard, "Only every N-th case from the I-th on")->type_name("I/N");
  add_file(*cmd, "--out", o->hunt.out, "Folder for rows.csv, findings and corpus; a hunt goes on there")
      ->type_name("FOLDER");
  whole_number(
      cmd->add_option("--again", o->again, "Drive the fresh case of this seed alone; --out writes it"), "N");
  add_file(*cmd, "--case", o->file, "Drive a case that a hunt wrote");
  cmd->add_option("--summary", o->summary, "Sum up these rows instead of hunting")->type_name("FILE");
  cmd->footer("\nExit status: 0 nothing found, 1 something found, 2 bad input or usage, 130 interrupted.");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
