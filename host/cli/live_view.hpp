/// --view: a run on a bus, watched in a browser while it goes on.
#pragma once

#include <memory>
#include <string>

#include "host/cli/cli11_forward.hpp"
#include "host/cli/interrupt.hpp"
#include "host/view/feed.hpp"
#include "host/view/server.hpp"

namespace whisker::cli {

/// A feed and who serves it.
class LiveView {
 public:
  /// Takes the port, but does not answer yet. Throws UsageError.
  LiveView(const std::string& address, int port, bool stay);
  /// Who listens is told the end, which takes some seconds at most.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  view::Feed& feed() { return feed_; }
  /// Begins to answer, and says where. A process must not fork any more then.
  void start();
  /// In a process that was forked before: the port is the parent's alone.
  void abandon() { server_.abandon(); }
  /// After the run: returns at the interruption, or at once where nobody asked to stay.
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

  /// Null where nobody asked for it. Throws UsageError.
  std::unique_ptr<LiveView> open() const;
};

/// --view, --view-address and --view-stay.
void add_view(CLI::App& app, ViewChoice& choice);

}  // namespace whisker::cli
