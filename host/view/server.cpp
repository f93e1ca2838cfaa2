#include "host/view/server.hpp"

#include <httplib.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <thread>

#include <fmt/core.h>

namespace whisker::view {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPace{50};     // between two events
constexpr milliseconds kQuiet{2000};  // a word after so long, so that one who is gone is noticed
constexpr milliseconds kStart{5000};
constexpr int kSpareThreads = 8;  // for the page

std::string id_of(const Place& place) { return fmt::format("{}/{}", place.run, place.next); }

/// What is no id is the beginning.
Place place_of(const std::string& id) {
  const std::size_t slash = id.find('/');
  Place place;
  if (slash == std::string::npos) return place;
  const char* const end = id.data() + id.size();
  const auto [rest, error] = std::from_chars(id.data() + slash + 1, end, place.next);
  if (error != std::errc{} || rest != end) return {};
  place.run = id.substr(0, slash);
  return place;
}

/// Two servers on one port would share its visitors; httplib would allow that.
void own_port(int socket) {
  const int on = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
}

}  // namespace

struct Server::Inside {
  const Feed& feed;
  const std::string page;
  httplib::Server http{};
  int port = 0;
  std::thread thread{};
  std::atomic<int> watchers{0};
  std::atomic<bool> stopping{false};

  Inside(const Feed& told, std::string text) : feed(told), page(std::move(text)) {}

  /// One who watches.
  class Stream {
   public:
    Stream(Inside& server, Place place) : server_(server), place_(std::move(place)) {}
    ~Stream() { --server_.watchers; }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// False: this one is gone.
    bool step(httplib::DataSink& sink) {
      if (server_.stopping) return false;
      if (server_.feed.over(place_)) {
        sink.done();
        return true;
      }
      const auto news = server_.feed.news(place_);
      if (news) return write(sink, fmt::format("id: {}\ndata: {}\n\n", id_of(place_), *news)) && pause();
      quiet_ += kPace;
      return (quiet_ < kQuiet || write(sink, ":\n\n")) && pause();
    }

   private:
    bool write(httplib::DataSink& sink, const std::string& text) {
      quiet_ = {};
      return sink.write(text.data(), text.size());
    }
    bool pause() {
      std::this_thread::sleep_for(kPace);
      return true;
    }

    Inside& server_;
    Place place_;
    milliseconds quiet_{0};
  };

  void watch(const httplib::Request& request, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    if (++watchers > kMostWatchers) {
      --watchers;
      response.status = 503;
      response.set_content("too many watch this run already\n", "text/plain");
      return;
    }
    const auto stream = std::make_shared<Stream>(*this, place_of(request.get_header_value("Last-Event-ID")));
    response.set_chunked_content_provider(
        "text/event-stream", [stream](std::size_t, httplib::DataSink& sink) { return stream->step(sink); });
  }
};

Server::Server(const std::string& address, int port, const Feed& feed, std::string page)
    : inside_(std::make_unique<Inside>(feed, std::move(page))) {
  Inside& in = *inside_;
  in.http.set_socket_options(own_port);
  in.http.set_tcp_nodelay(true);
  in.http.set_keep_alive_max_count(1);
  in.http.set_keep_alive_timeout(2);
  in.http.set_read_timeout(std::chrono::seconds(2));
  in.http.set_write_timeout(std::chrono::seconds(2));
  in.http.set_payload_max_length(0);
  in.http.new_task_queue = [] { return new httplib::ThreadPool(kMostWatchers + kSpareThreads); };
  in.http.Get("/", [&in](const httplib::Request&, httplib::Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_content(in.page, "text/html; charset=utf-8");
  });
  in.http.Get(
      std::string("/") + kEvents,
      [&in](const httplib::Request& request, httplib::Response& response) { in.watch(request, response); });
  errno = 0;
  in.port = port == 0 ? in.http.bind_to_any_port(address) : in.http.bind_to_port(address, port) ? port : -1;
  if (in.port < 0) {
    throw ServerError(fmt::format("cannot serve on {}, port {}: {}", address, port,
                                  errno != 0 ? std::generic_category().message(errno) : "no such address"));
  }
}

Server::~Server() {
  if (!inside_->thread.joinable()) return;
  inside_->stopping = true;
  inside_->http.stop();
  inside_->thread.join();
}

int Server::port() const { return inside_->port; }

void Server::start() {
  Inside& in = *inside_;
  in.thread = std::thread([&in] { in.http.listen_after_bind(); });
  // Before it listens, a stop() would be forgotten.
  for (milliseconds waited{0}; !in.http.is_running(); waited += milliseconds(1)) {
    if (waited > kStart) throw ServerError("the server does not start");
    std::this_thread::sleep_for(milliseconds(1));
  }
}

void Server::wait_for_watchers(milliseconds most) const {
  for (milliseconds waited{0}; inside_->watchers > 0 && waited < most; waited += milliseconds(10)) {
    std::this_thread::sleep_for(milliseconds(10));
  }
}

}  // namespace whisker::view
