#include <memory>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "firmware/can/ids.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/options.hpp"
#include "host/protocol/dbc.hpp"
#include "host/protocol/page.hpp"
#include "host/scenario/params_text.hpp"

namespace whisker::cli {

void add_dbc(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("dbc", "Print the CAN protocol as a DBC file");
  const auto robot = std::make_shared<int>(1);
  cmd->add_option("--robot", *robot, "Whose identifiers: 1 to 7")
      ->check(CLI::Range(1, static_cast<int>(can::kRobots)))
      ->type_name("N");
  cmd->callback([robot, &status] {
    fmt::print("{}", protocol::dbc(static_cast<std::uint8_t>(*robot)));
    status = 0;
  });
}

void add_protocol(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("protocol", "Print the CAN protocol for a reader (Markdown)");
  const auto params = std::make_shared<bool>(false);
  cmd->add_flag("--parameters", *params, "The robot's parameters in the units of a scenario file instead");
  cmd->callback([params, &status] {
    fmt::print("{}", *params ? params_markdown() : protocol::page());
    status = 0;
  });
}

}  // namespace whisker::cli
