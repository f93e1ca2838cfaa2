#include "host/cli/live_view.hpp"

#include <chrono>
#include <thread>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/view/names.hpp"

namespace whisker::cli {
namespace {

constexpr std::chrono::milliseconds kFarewell{3000};

}  // namespace

LiveView::LiveView(const std::string& address, int port, bool stay, PlannerKind planner) try
    : server_(address, port, feed_, page::live_page(view::kEvents, controller_picture(planner))),
      address_(address),
      stay_(stay) {
} catch (const view::ServerError& e) {
  throw UsageError(fmt::format("--view: {}", e.what()));
}

void LiveView::start() {
  server_.start();
  if (!view::is_loopback(address_)) {
    fmt::print(stderr, "whoever can reach {} port {} can watch this run\n", address_, server_.port());
  }
  fmt::print(stderr, "watch it at {}\n", server_.url());
}

void LiveView::stay(const Interrupt& interrupt) const {
  if (!stay_ || interrupt.noted()) return;
  finish_standard_output();
  fmt::print(stderr, "the run is over and can still be watched; Ctrl-C ends\n");
  while (!interrupt.noted()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

LiveView::~LiveView() {
  feed_.close();
  server_.wait_for_watchers(kFarewell);
}

std::unique_ptr<LiveView> ViewChoice::open(PlannerKind planner) const {
  if (option->count() == 0) return nullptr;
  return std::make_unique<LiveView>(address, port.empty() ? kDefaultPort : std::stoi(port), stay, planner);
}

void add_view(CLI::App& app, ViewChoice& choice) {
  CLI::Option* const view =
      app.add_option("--view", choice.port,
                     fmt::format("Serve a page that shows the run while it goes on; 0: any free port;\n"
                                 "default: {}",
                                 ViewChoice::kDefaultPort))
          ->expected(0, 1)
          ->transform(CLI::Validator(
              [](std::string& text) { return text.empty() ? std::string() : whole_number(65535)(text); }, ""))
          ->type_name("[PORT]");
  choice.option = view;
  add_name(app, "--view-address", choice.address, "Where to serve it, for others to watch")
      ->needs(view)
      ->capture_default_str()
      ->type_name("ADDRESS");
  add_switch(app, "--view-stay", choice.stay, "Go on serving when the run is over, until Ctrl-C")
      ->needs(view);
}

}  // namespace whisker::cli
