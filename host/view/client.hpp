/// One connection: a request, what it is answered, and the end. It has a time for each.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "host/view/feed.hpp"
#include "host/view/request.hpp"
#include "host/view/socket.hpp"

namespace whisker::view {

using Clock = std::chrono::steady_clock;

/// Bytes to send, of any number of clients.
using Bytes = std::shared_ptr<const std::string>;

class Client {
 public:
  Client(Socket socket, Clock::time_point now);

  int descriptor() const { return socket_.descriptor(); }
  /// For poll().
  short waits_for() const;
  bool gone() const { return state_ == State::gone; }
  bool watches() const { return state_ == State::watching; }

  /// Moves what can be moved. A request is handed over once.
  std::optional<Asked> move(Clock::time_point now);
  /// Sends this and hangs up.
  void answer(Bytes bytes, Clock::time_point now);
  /// Sends this, and from then on what the feed tells, until it is over.
  void watch(Bytes head, Place place, Clock::time_point now);
  /// True: it would take the feed's next news.
  bool listens(Clock::time_point now) const;
  /// Takes what has come, or ends with the feed. True: that took some work.
  bool tell(const Feed& feed, Clock::time_point now);

 private:
  enum class State {
    asking,
    answering,
    watching,
    leaving,  ///< has been told all: only what it still sends is waited out, lest that cut the answer off
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
  Clock::time_point until_;    ///< this state, or these bytes, must have ended
  Clock::time_point stalled_;  ///< it must have taken something
  Clock::time_point next_;     ///< the next news
  Clock::time_point quiet_;    ///< a word, so that one who is gone is noticed
  Place place_;
};

}  // namespace whisker::view
