/// Serves the page of a feed and its events to browsers.
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/lab/view/feed.hpp"

namespace whisker::view {

/// The address is not available; what() is the reason in one line.
struct ServerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr const char* kEvents = "events";  ///< their path, relative to the page

/// GET /: the page. GET /events: server-sent events with the output of Feed::news, and an id from which a
/// browser continues after a break. At most kMostWatchers listen at once; the next one is refused with 503.
///
/// The server runs in the process that drives, so it limits the memory and time of its clients: one thread
/// serves all; a request has two seconds and 16 kB; a client that reads nothing for two seconds, or needs ten
/// for an answer, is disconnected; of 128 connections, the oldest that is not a watcher makes room for the
/// next. It answers only under its own names (Names).
class Server {
 public:
  static constexpr int kMostWatchers = 24;

  /// Binds the port; 0: any free one. The feed must outlive it. Throws ServerError.
  Server(const std::string& address, int port, const Feed& feed, const std::string& page);
  /// Disconnects all clients.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// Address of the page.
  const std::string& url() const;
  /// Call once: starts to answer in its own thread.
  void start();
  /// In a process that was forked before start(): closes the port, which belongs to the parent.
  void abandon();
  /// Waits until all watchers have received everything, up to this time.
  void wait_for_watchers(std::chrono::milliseconds most) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace whisker::view
