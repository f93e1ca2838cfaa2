#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/report/file.hpp"
#include "host/scenario/write.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::cli {
namespace {

struct WorldOptions {
  std::string kind;
  worlds::Options world;
  std::string out;
};

std::string generated(const WorldOptions& o) {
  try {
    return to_toml(worlds::generate(*worlds::kind_named(o.kind), o.world));
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

int execute(const WorldOptions& o) {
  check_outputs({o.out});
  const std::string text = generated(o);
  if (o.out.empty()) {
    fmt::print("{}", text);
  } else {
    report::write_file(o.out, text);
  }
  return 0;
}

}  // namespace

void add_world(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("world", "Make a random scenario file");
  const auto o = std::make_shared<WorldOptions>();
  cmd->add_option("KIND", o->kind,
                  "discs, poles, u-trap, spiral, maze, rooms, enclosed,\nenclosed-at-wall, gap-at-wall, "
                  "contest-maze, gap or disc-gap")
      ->required()
      ->check([](const std::string& text) {
        std::vector<std::string_view> kinds;
        for (const worlds::Kind kind : worlds::kAllKinds) kinds.emplace_back(name(kind));
        return worlds::kind_named(text) ? "" : fmt::format("no kind '{}'{}", text, did_you_mean(text, kinds));
      });
  cmd->add_option("--seed", o->world.seed, "The same seed gives the same world everywhere")
      ->required()
      ->transform(whole_number())
      ->type_name("N");
  cmd->add_option("--discs", o->world.discs, "Number of discs; 30 by default for kind discs")
      ->transform(whole_number(200))
      ->type_name("N");
  add_gap_width(*cmd, o->world.gap_m, "Of the gap, 0.16 to 1 m; 0.32 by default (kinds gap, disc-gap)");
  add_switch(*cmd, "--box", o->world.box, "A closed box around it (kinds discs, poles, enclosed)");
  add_switch(*cmd, "--noise", o->world.noise, "With the reference robot's sensor noise and odometry error");
  add_wheel_scale_sigma(*cmd, o->world.wheel_scale_sigma,
                        "With --noise: scale error of the wheels, instead of 0.0001");
  add_file(*cmd, "--out", o->out, "File to write, instead of standard output");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
