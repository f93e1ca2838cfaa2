/// One connection: request, answer, end, with a time limit for each.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "host/lab/view/feed.hpp"
#include "host/lab/view/request.hpp"
#include "host/lab/view/socket.hpp"

namespace whisker::view {

using Clock = std::chrono::steady_clock;

/// Bytes to send to any number of clients.
using Bytes = std::shared_ptr<const std::string>;

class Client {
 public:
  Client(Socket socket, Clock::time_point now);

  int descriptor() const { return socket_.descriptor(); }
  /// For poll().
  short waits_for() const;
  bool gone() const { return state_ == State::gone; }
  bool watches() const { return state_ == State::watching; }

  /// Transfers what is possible without blocking. Returns a request once.
  std::optional<Asked> move(Clock::time_point now);
  /// Sends this and closes.
  void answer(Bytes bytes, Clock::time_point now);
  /// Sends this, and then the news of the feed until it ends.
  void watch(Bytes head, Place place, Clock::time_point now);
  /// True: ready for the next news of the feed.
  bool listens(Clock::time_point now) const;
  /// Accepts news, or ends with the feed. True: this took some work.
  bool publish(const Feed& feed, Clock::time_point now);

 private:
  enum class State {
    asking,
    answering,
    watching,
    leaving,  ///< everything is sent; waits for the remaining input, so that the answer is not cut off
    gone,
  };

  std::optional<Asked> read();
  void write(Clock::time_point now);
  void put(Bytes bytes, Clock::time_point now);
  void leave(Clock::time_point now);
  void check_time(Clock::time_point now);

  Socket socket_;
  State state_ = State::asking;
  bool said_all_ = false;
  Head head_;
  Bytes out_;
  std::size_t sent_ = 0;
  Clock::time_point until_;    ///< deadline of this state or of these bytes
  Clock::time_point stalled_;  ///< deadline for the client to read something
  Clock::time_point next_;     ///< time of the next news
  Clock::time_point quiet_;    ///< time of a keep-alive message, which detects a closed connection
  Place place_;
};

}  // namespace whisker::view
