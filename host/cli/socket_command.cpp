#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/socket/channel.hpp"
#include "host/harness/socket/session.hpp"
#include "host/lab/report/result.hpp"
#include "host/lab/view/names.hpp"

namespace whisker::cli {
namespace {

constexpr std::uint64_t kMostPort = 65535;

struct SocketOptions {
  std::string address = "127.0.0.1";
  std::uint64_t tcp = 0;
  std::uint64_t udp = 0;
  bool has_tcp = false;
  bool has_udp = false;
  bool standard = false;
  std::string robot;
  PlannerKind planner = kDefaultPlanner;
  double timeout_s = 10;
  bool json = false;
};

std::unique_ptr<socket::Channel> open_channel(const SocketOptions& o) {
  if (o.has_tcp + o.has_udp + o.standard != 1)
    throw UsageError("socket needs one of --tcp, --udp and --stdio");
  if (o.standard && o.json) throw UsageError("--json: --stdio takes the standard output");
  if (o.standard) return socket::standard_channel();
  const auto say_port = [&](int port) {
    fmt::print(stderr, "listening on port {}\n", port);
    if (!view::is_loopback(o.address))
      fmt::print(stderr, "whoever can reach {} port {} can drive this robot\n", o.address, port);
  };
  if (o.has_tcp) return socket::accept_tcp(o.address, static_cast<int>(o.tcp), o.timeout_s, say_port);
  return socket::bind_udp(o.address, static_cast<int>(o.udp), say_port);
}

std::uint32_t now_ms() {
  namespace chrono = std::chrono;
  static const auto began = chrono::steady_clock::now();
  return static_cast<std::uint32_t>(
      chrono::duration_cast<chrono::milliseconds>(chrono::steady_clock::now() - began).count());
}

void refuse(socket::Channel& channel, const std::string& why, double timeout_s) {
  fmt::print(stderr, "whisker: {}\n", why);
  channel.write(nlohmann::json{{"error", why}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                timeout_s);
  channel.hang_up(timeout_s);
}

/// Until the other end closes. False: a line was refused.
bool serve(socket::Channel& channel, socket::Session& session, double timeout_s) {
  try {
    while (const auto line = channel.read(timeout_s))
      channel.write(session.answer(*line, now_ms()), timeout_s);
    return true;
  } catch (const socket::ProtocolError& e) {
    refuse(channel, e.what(), timeout_s);
  } catch (const socket::LongLine& e) {
    refuse(channel, fmt::format("line {}: {}", session.lines() + 1, e.what()), timeout_s);
  }
  return false;
}

/// Nothing if there was no tick.
void say_end(const std::optional<socket::SessionEnd>& end, const socket::Session& session, bool json) {
  if (!end) return;
  if (json) fmt::print("{}\n", report::result_json(end->run, "", end->outcome));
  fmt::print(stderr, "{} after {} s, {} lines ({})\n", end->outcome, end->run.time_s, session.lines(),
             end->run.detail);
}

int execute(const SocketOptions& o) {
  socket::Opening defaults;
  defaults.planner = o.planner;
  if (!o.robot.empty()) apply_robot_file(defaults.robot, o.robot);
  bend_if_chosen(defaults.robot, o.planner);
  std::signal(SIGPIPE, SIG_IGN);  // a closed end is reported as an error of write()
  socket::Session session(defaults, version());
  try {
    const auto channel = open_channel(o);
    if (!serve(*channel, session, o.timeout_s)) return kBadInput;
  } catch (const socket::ChannelError& e) {
    fmt::print(stderr, "whisker: {}\n", e.what());
    say_end(session.result(), session, o.json);
    return kFailure;
  }
  const auto end = session.result();
  if (!end) throw UsageError("the other end closed before a tick");
  say_end(end, session, o.json);
  return exit_status(end->run.verdict);
}

}  // namespace

void add_socket(CLI::App& app, int& status) {
  CLI::App* cmd = app.add_subcommand("socket", "Drive the robot of another simulator: docs/socket.md");
  const auto o = std::make_shared<SocketOptions>();
  CLI::Option* tcp =
      whole_number(cmd->add_option("--tcp", o->tcp, "Wait for one client on this port; 0: any free port"),
                   "PORT", kMostPort);
  CLI::Option* udp =
      whole_number(cmd->add_option("--udp", o->udp, "One datagram a line on this port; 0: any free port"),
                   "PORT", kMostPort);
  add_switch(*cmd, "--stdio", o->standard, "Lines on standard input and output");
  add_name(*cmd, "--address", o->address, "IPv4 address to listen on; 127.0.0.1 by default")->type_name("A");
  add_file(*cmd, "--robot", o->robot, "Parameters; those of the first line override them");
  add_planner(*cmd, o->planner);
  amount(cmd->add_option("--timeout", o->timeout_s,
                         "Longest wait for a client, a line or its reader; 10 s by default"),
         "S", 1e6);
  add_switch(*cmd, "--json", o->json, "Print the result as one JSON object");
  cmd->callback([o, tcp, udp, &status] {
    o->has_tcp = tcp->count() > 0;
    o->has_udp = udp->count() > 0;
    status = execute(*o);
  });
}

}  // namespace whisker::cli
