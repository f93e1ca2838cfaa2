#include "host/lab/view/server.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <poll.h>

#include "host/lab/view/client.hpp"
#include "host/lab/view/names.hpp"

namespace whisker::view {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMostClients = 128;
constexpr milliseconds kTurn{20};     // between two polls of the feed
constexpr milliseconds kWork{50};     // of work at most before all clients are served again
constexpr milliseconds kNoRoom{100};  // before the next attempt to accept

/// An invalid id means the beginning.
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

const char* name_of(int status) {
  switch (status) {
    case 200: return "OK";
    case 400: return "Bad Request";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 421: return "Misdirected Request";
    case 431: return "Request Header Fields Too Large";
    case 503: return "Service Unavailable";
    case 505: return "HTTP Version Not Supported";
    default: return "Error";
  }
}

/// With the empty line that ends it. The headers forbid caching and use by other sites.
std::string head_of(int status, const char* type, const std::string& more = "") {
  return fmt::format(
      "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
      "Cross-Origin-Resource-Policy: same-origin\r\nX-Frame-Options: DENY\r\nConnection: close\r\n{}\r\n",
      status, name_of(status), type, more);
}

Bytes whole(int status, const char* type, const std::string& body, const std::string& more = "") {
  const std::string length = fmt::format("Content-Length: {}\r\n", body.size());
  return std::make_shared<std::string>(head_of(status, type, length + more) + body);
}

}  // namespace

struct Server::Inside {
  const Feed& feed;
  Socket listening;
  const int port;
  const Names names;
  const Bytes page;
  const Bytes stream = std::make_shared<std::string>(head_of(200, "text/event-stream"));
  Bell bell{};
  std::thread thread{};
  std::atomic<int> watchers{0};
  std::atomic<bool> stopping{false};
  std::vector<Client> clients{};
  Clock::time_point accepts{};
  std::size_t first{0};  // of the clients that publish() serves

  Inside(const std::string& address, int wanted, const Feed& source, const std::string& text)
      : feed(source),
        listening(listen_on(address, wanted)),
        port(port_of(listening)),
        names(address, port),
        page(whole(200, "text/html; charset=utf-8", text)) {}

  void run();
  void wait(Clock::time_point now);
  void accept(Clock::time_point now);
  void make_room();
  void serve(Client& client, const Asked& asked, Clock::time_point now);
  void publish();
  void count();
};

void Server::Inside::run() {
  while (!stopping) {
    wait(Clock::now());
    const auto now = Clock::now();
    for (Client& client : clients) {
      if (const auto asked = client.move(now)) serve(client, *asked, now);
    }
    accept(now);
    publish();
    clients.erase(std::remove_if(clients.begin(), clients.end(), [](const Client& c) { return c.gone(); }),
                  clients.end());
    count();
  }
  clients.clear();
}

void Server::Inside::wait(Clock::time_point now) {
  std::vector<pollfd> all{{bell.descriptor(), POLLIN, 0},
                          {now >= accepts ? listening.descriptor() : -1, POLLIN, 0}};
  for (const Client& client : clients) all.push_back({client.descriptor(), client.waits_for(), 0});
  const bool idle = clients.empty() && now >= accepts;
  poll(all.data(), all.size(), idle ? -1 : static_cast<int>(kTurn.count()));
}

void Server::Inside::accept(Clock::time_point now) {
  if (now < accepts) return;
  for (;;) {
    Socket socket;
    const Accepted came = accept_one(listening, socket);
    if (came == Accepted::no_descriptor) {
      accepts = now + kNoRoom;
      make_room();
    }
    if (came != Accepted::one) return;
    if (clients.size() >= kMostClients) make_room();
    clients.emplace_back(std::move(socket), now);
  }
}

/// Closes the client that has been connected longest without watching.
void Server::Inside::make_room() {
  const auto oldest =
      std::find_if(clients.begin(), clients.end(), [](const Client& c) { return !c.watches(); });
  if (oldest != clients.end()) clients.erase(oldest);
}

void Server::Inside::serve(Client& client, const Asked& asked, Clock::time_point now) {
  const auto say = [&](int status, const std::string& words, const std::string& more = "") {
    client.answer(whole(status, "text/plain; charset=utf-8", words + "\n", more), now);
  };
  const Request& request = asked.request;
  if (asked.status != 200) {
    say(asked.status, asked.fault, asked.status == 405 ? "Allow: GET\r\n" : "");
  } else if (!names.knows(request.host)) {
    say(421, fmt::format("this server has another name: open {}", names.url()));
  } else if (request.origin && !Names::same(*request.origin, request.host)) {
    say(403, "only this server's own page may ask it");
  } else if (request.path == "/") {
    client.answer(page, now);
  } else if (request.path != std::string("/") + kEvents) {
    say(404, "there is nothing here but the page at /");
  } else if (watchers >= kMostWatchers) {
    say(503, fmt::format("{} watch this run already, and there is no room for more", kMostWatchers),
        "Retry-After: 2\r\n");
  } else {
    client.watch(stream, place_of(request.last_event_id), now);
    ++watchers;
  }
}

/// Clients not served this time are first next time.
void Server::Inside::publish() {
  const auto until = Clock::now() + kWork;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    Client& client = clients[(first + i) % clients.size()];
    const auto now = Clock::now();
    if (!client.listens(now) || !client.publish(feed, now) || Clock::now() < until) continue;
    first += i + 1;
    return;
  }
}

void Server::Inside::count() {
  watchers = static_cast<int>(
      std::count_if(clients.begin(), clients.end(), [](const Client& c) { return c.watches(); }));
}

Server::Server(const std::string& address, int port, const Feed& feed, const std::string& page)
    : inside_(std::make_unique<Inside>(address, port, feed, page)) {}

Server::~Server() {
  if (!inside_->thread.joinable()) return;
  inside_->stopping = true;
  inside_->bell.ring();
  inside_->thread.join();
}

int Server::port() const { return inside_->port; }

const std::string& Server::url() const { return inside_->names.url(); }

void Server::start() {
  inside_->thread = std::thread([this] { inside_->run(); });
}

void Server::abandon() {
  inside_->listening.close();
  inside_->bell.close();
}

void Server::wait_for_watchers(milliseconds most) const {
  for (milliseconds waited{0}; inside_->watchers > 0 && waited < most; waited += milliseconds(10)) {
    std::this_thread::sleep_for(milliseconds(10));
  }
}

}  // namespace whisker::view
