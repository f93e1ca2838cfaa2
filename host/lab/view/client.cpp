#include "host/lab/view/client.hpp"

#include <utility>

#include <fmt/core.h>
#include <poll.h>

namespace whisker::view {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kToAsk{2};
constexpr seconds kToTake{10};  // for an answer or an event
constexpr seconds kStalled{2};
constexpr seconds kToLeave{1};
constexpr milliseconds kSyncMode{50};  // between two events
constexpr seconds kQuiet{2};

std::string id_of(const Place& place) { return fmt::format("{}/{}", place.run, place.next); }

}  // namespace

Client::Client(Socket socket, Clock::time_point now) : socket_(std::move(socket)), until_(now + kToAsk) {}

short Client::waits_for() const {
  // A watching client sends nothing more, but may close the connection.
  return static_cast<short>((out_ ? POLLOUT : 0) | (said_all_ ? 0 : POLLIN));
}

std::optional<Asked> Client::move(Clock::time_point now) {
  const auto asked = read();
  if (out_) write(now);
  check_time(now);
  return asked;
}

std::optional<Asked> Client::read() {
  char bytes[4096];
  // A few bytes at a time, so that other clients are served too.
  for (int i = 0; i < 4 && !said_all_; ++i) {
    const Moved moved = receive(socket_, bytes, sizeof bytes);
    said_all_ = moved.ended;
    // A client that closed its sending side may still wait for the answer.
    if (moved.ended && state_ != State::answering) state_ = State::gone;
    if (moved.bytes == 0) break;
    if (state_ != State::asking) continue;
    if (auto asked = head_.add({bytes, moved.bytes})) return asked;
  }
  return std::nullopt;
}

void Client::write(Clock::time_point now) {
  const Moved moved = send(socket_, std::string_view(*out_).substr(sent_));
  if (moved.ended) state_ = State::gone;
  if (moved.bytes > 0) stalled_ = now + kStalled;
  sent_ += moved.bytes;
  if (sent_ < out_->size()) return;
  out_.reset();
  quiet_ = now + kQuiet;
  if (state_ == State::answering) leave(now);
}

void Client::put(Bytes bytes, Clock::time_point now) {
  out_ = std::move(bytes);
  sent_ = 0;
  until_ = now + kToTake;
  stalled_ = now + kStalled;
  write(now);
}

void Client::answer(Bytes bytes, Clock::time_point now) {
  state_ = State::answering;
  put(std::move(bytes), now);
}

void Client::watch(Bytes head, Place place, Clock::time_point now) {
  state_ = State::watching;
  place_ = std::move(place);
  next_ = now;
  put(std::move(head), now);
}

bool Client::listens(Clock::time_point now) const {
  return state_ == State::watching && !out_ && now >= next_;
}

bool Client::publish(const Feed& feed, Clock::time_point now) {
  if (feed.over(place_)) {
    leave(now);
    return false;
  }
  next_ = now + kSyncMode;
  const auto news = feed.news(place_);
  if (news) {
    put(std::make_shared<std::string>(fmt::format("id: {}\ndata: {}\n\n", id_of(place_), *news)), now);
  } else if (now >= quiet_) {
    put(std::make_shared<std::string>(":\n\n"), now);
  }
  return news.has_value();
}

void Client::leave(Clock::time_point now) {
  state_ = said_all_ ? State::gone : State::leaving;
  end_sending(socket_);
  until_ = now + kToLeave;
}

void Client::check_time(Clock::time_point now) {
  const bool sends = out_ != nullptr;
  const bool timed = sends || state_ == State::asking || state_ == State::leaving;
  if ((timed && now >= until_) || (sends && now >= stalled_)) state_ = State::gone;
}

}  // namespace whisker::view
