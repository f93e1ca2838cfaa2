#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/aliases.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/hil/line.hpp"
#include "host/harness/scenario/error.hpp"

namespace {

using Words = std::vector<std::string>;

/// The command that the line names, with its own commands: "whisker robot check".
std::string named(const CLI::App& app, const Words& words, std::size_t at = 0) {
  std::string name = app.get_name();
  for (const CLI::App* command : app.get_subcommands({}))
    if (at < words.size() && command->get_name() == words[at]) name += " " + named(*command, words, at + 1);
  return name;
}

/// CLI11 would only report that a subcommand is missing.
void check_command(const CLI::App& app, const Words& words, std::size_t at = 0) {
  if (words.size() <= at && at > 0) {
    const std::string first = app.get_subcommands({}).front()->get_name();
    throw whisker::cli::UsageError(
        fmt::format("{0} needs a command: whisker {0} {1}", app.get_name(), first));
  }
  if (words.size() <= at) return;
  const std::string& word = words[at];
  if (word[0] == '-') {
    if (app.get_option_no_throw(word) != nullptr) return;
    throw CLI::ParseError(fmt::format("no option '{}'", word), CLI::ExitCodes::ExtrasError);
  }
  std::vector<std::string_view> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    known.emplace_back(command->get_name());
    if (command->get_name() != word) continue;
    const bool has_commands = !command->get_subcommands({}).empty();
    return has_commands ? check_command(*command, words, at + 1) : void();
  }
  throw CLI::ParseError(fmt::format("no command '{}'{}", word, whisker::cli::did_you_mean(word, known)),
                        CLI::ExitCodes::ExtrasError);
}

/// Parses and runs; help and version count as success. The command that runs sets `status`.
int parse(CLI::App& app, const Words& words, const int& status) {
  try {
    check_command(app, words);
    app.parse(Words{words.rbegin(), words.rend()});
    return status;
  } catch (const CLI::Success& e) {
    return app.exit(e);
  }
}

/// One line, even if a library's message has several. Not fmt: it throws if standard error is closed.
void complain(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fputs((whisker::one_line(text) + "\n").c_str(), stderr);
}

constexpr const char* kExitStatus = R"(
Exit status of run, hil and plant: 0 reached and truly there, 7 the robot says reached and is off
the goal, 3 unreachable, 4 time limit or gave up, 5 contact, 6 fault (safe stop),
2 bad input or usage, 1 anything else.)";

constexpr const char* kCampaignExitStatus = R"(
Exit status of campaign: 0 whatever the missions came to, 130 interrupted,
2 bad input or usage, 1 anything else.)";

constexpr const char* kFirstSteps = R"(

First steps:
  whisker world discs --seed 1 --out discs.toml
  whisker run discs.toml --html discs.html --trace discs.csv
  whisker table --svg table.svg)";

}  // namespace

int main(int argc, char** argv) {
  using namespace whisker::cli;
  end_on_signals();
  CLI::App app{"Whisker: a navigation core for small robots with three rangefinders, in a simulated world."};
  app.name("whisker");
  app.require_subcommand(1);
  app.set_version_flag("--version", "whisker " + version());
  const Words words = with_present_names({argv + 1, argv + argc});
  int status = kFailure;
  add_run(app, status);
  add_world(app, status);
  add_robot(app, status);
  add_campaign(app, status);
  add_movers(app, status);
  add_guard(app, status);
  add_hunt(app, status);
  add_operators(app, status);
  add_table(app, status);
  add_rules(app, status);
  add_plant(app, status);
  add_controller(app, status);
  add_hil(app, status);
  add_bench(app, status);
  add_replay(app, status);
  add_socket(app, status);
  add_protocol(app, status);
  app.footer(std::string(kExitStatus) + kCampaignExitStatus + kFirstSteps);
  for (const char* name : {"run", "hil", "plant"}) app.get_subcommand(name)->footer(kExitStatus);
  app.get_subcommand("campaign")->footer(kCampaignExitStatus);
  try {
    status = parse(app, words, status);
    finish_standard_output();
    return status;
  } catch (const Interrupted& e) {
    std::fflush(stdout);
    complain(fmt::format("whisker: interrupted{}", e.what()));
    return kInterrupted;
  } catch (const CLI::ParseError& e) {
    complain(fmt::format("whisker: {} (see {} --help)", e.what(), named(app, words)));
    return kBadInput;
  } catch (const UsageError& e) {
    complain(fmt::format("whisker: {}", e.what()));
    return kBadInput;
  } catch (const whisker::hil::BusError& e) {
    complain(fmt::format("whisker: {}", e.what()));
    return kBadInput;
  } catch (const whisker::InputErrors& e) {
    for (const whisker::InputError& error : e.all()) complain(error.what());
    if (!e.advice().empty()) complain(e.advice());
    return kBadInput;
  } catch (const whisker::InputError& e) {
    complain(e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    complain(fmt::format("whisker: {}", e.what()));
    return kFailure;
  }
}
