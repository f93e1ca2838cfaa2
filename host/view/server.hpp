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
/// browser goes on after a break. At most kMostWatchers listen at once; the next one is refused with 503.
///
/// It runs in the process that drives, so nobody can make it grow or keep it busy: one thread serves all; a
/// request has two seconds and 16 kB; one that takes nothing for two seconds, or an answer for ten, is let
/// go; the oldest of 128 that only ask makes room for the next. It answers to its own names only (Names).
class Server {
 public:
  static constexpr int kMostWatchers = 24;

  /// Takes the port; 0: any that is free. The feed must outlive it. Throws ServerError.
  Server(const std::string& address, int port, const Feed& feed, const std::string& page);
  /// Lets everybody go.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// Where the page is.
  const std::string& url() const;
  /// Once: begins to answer, in a thread of its own.
  void start();
  /// In a process that was forked before start(): the port is the parent's alone.
  void abandon();
  /// Waits until whoever listens has been told all, but no longer than this.
  void wait_for_watchers(std::chrono::milliseconds most) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace whisker::view
