/// Serves the page of a feed and its events to browsers.
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/view/feed.hpp"

namespace whisker::view {

/// The address cannot be served; what() is the one line that says why.
struct ServerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr const char* kEvents = "events";  ///< their path, from that of the page

/// GET /: the page. GET /events: server-sent events, each what Feed::news says, and under the id by which a
/// browser goes on after a break. At most kMostWatchers listen at once; one that takes nothing for two
/// seconds is let go.
class Server {
 public:
  static constexpr int kMostWatchers = 24;

  /// Takes the port; 0: any that is free. The feed must outlive it. Throws ServerError.
  Server(const std::string& address, int port, const Feed& feed, std::string page);
  /// Lets everybody go, which takes some seconds at most.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// Once: begins to answer, in threads of its own.
  void start();
  /// Waits until whoever listens has been told all, but no longer than this.
  void wait_for_watchers(std::chrono::milliseconds most) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace whisker::view
