/// --view: shows a run on a bus in a browser while it goes on.
#pragma once

#include <memory>
#include <string>

#include "host/cli/cli11_forward.hpp"
#include "host/cli/output.hpp"
#include "host/harness/run/planners.hpp"
#include "host/lab/view/feed.hpp"
#include "host/lab/view/server.hpp"

namespace whisker::cli {

/// A feed and its server.
class LiveView {
 public:
  /// Binds the port, but does not answer yet. Throws UsageError.
  LiveView(const std::string& address, int port, bool stay, PlannerKind planner);
  /// Sends the end to all watchers, which takes some seconds at most.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  view::Feed& feed() { return feed_; }
  /// Starts to answer, and prints the address. The process must not fork after this.
  void start();
  /// In a process that was forked before: closes the port, which belongs to the parent.
  void abandon() { server_.abandon(); }
  /// After the run: returns at an interruption, or at once without --view-stay.
  void stay(const Interrupt& interrupt) const;

 private:
  view::Feed feed_;
  view::Server server_;
  std::string address_;
  bool stay_;
};

struct ViewChoice {
  static constexpr int kDefaultPort = 8765;
  std::string port;  ///< "" for the default
  std::string address = "127.0.0.1";
  bool stay = false;
  const CLI::Option* option = nullptr;

  /// Null without --view. planner: whose response table the page shows. Throws UsageError.
  std::unique_ptr<LiveView> open(PlannerKind planner = kDefaultPlanner) const;
};

/// --view, --view-address and --view-stay.
void add_view(CLI::App& app, ViewChoice& choice);

}  // namespace whisker::cli
