#include "host/lab/view/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/lab/view/names.hpp"
#include "host/lab/view/request.hpp"
#include "tests/view/http.hpp"
#include "tests/view/watched.hpp"

namespace whisker::view {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::ask;
using testing::drive;
using testing::get;
using ::testing::HasSubstr;
using testing::kHere;
using testing::Line;
using testing::setting;
using testing::short_run;

constexpr const char* kPath = "/events";

struct Event {
  std::string id;
  json news;
};

/// The complete events of a stream.
std::vector<Event> events_of(const std::string& text) {
  std::vector<Event> events;
  std::size_t from = 0;
  for (std::size_t end = 0; (end = text.find("\n\n", from)) != std::string::npos; from = end + 2) {
    const std::string block = text.substr(from, end - from);
    const std::size_t line = block.find('\n');
    if (block.rfind("id: ", 0) != 0) continue;
    EXPECT_EQ(block.compare(line + 1, 6, "data: "), 0) << block.substr(0, 100);
    events.push_back({block.substr(4, line - 4), json::parse(block.substr(line + 7))});
  }
  return events;
}

/// All events that the server sends from this position.
std::vector<Event> listen(int port, const std::string& from = "") {
  const Answer answer = get(port, kPath, from.empty() ? "" : "Last-Event-ID: " + from + "\r\n");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.header("Content-Type"), "text/event-stream");
  return events_of(answer.body);
}

std::size_t ticks_of(const std::vector<Event>& events) {
  std::size_t ticks = events.empty() ? 0 : events.front().news["from"].get<std::size_t>();
  for (const Event& event : events) {
    EXPECT_EQ(event.news["from"], ticks);
    ticks += event.news["columns"][0][3].get<std::size_t>();
  }
  return ticks;
}

/// A connection that requested the events; it reads only when the test calls it.
class Idle {
 public:
  explicit Idle(int port) : line_(port, 4096) { line_.send(ask(port, kPath) + "\r\n"); }
  std::string read_some() const { return line_.read_some(); }

 private:
  Line line_;
};

TEST(Server, ServesThePageAndNothingElse) {
  const Feed feed;
  Server server(kHere, 0, feed, "<p>page</p>");
  server.start();
  const Answer page = get(server.port(), "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<p>page</p>");
  EXPECT_THAT(page.header("Content-Type"), HasSubstr("text/html"));
  EXPECT_EQ(page.header("Cache-Control"), "no-store");
  EXPECT_EQ(get(server.port(), "/?x").status, 200);
  for (const char* path : {"/nothing", "/../etc/passwd", "/events/x"}) {
    EXPECT_EQ(get(server.port(), path).status, 404) << path;
  }
}

TEST(Server, TellsEverybodyAllAndThenLetsThemGo) {
  Feed feed;
  Server server(kHere, 0, feed, "");
  server.start();
  const auto watch = [&server] { return listen(server.port()); };
  auto first = std::async(std::launch::async, watch);
  auto second = std::async(std::launch::async, watch);
  const RunResult result = drive(short_run(), feed);
  const auto late = watch();
  for (const auto& events : {first.get(), second.get(), late}) {
    ASSERT_FALSE(events.empty());
    EXPECT_TRUE(events.front().news.contains("setting"));
    EXPECT_EQ(ticks_of(events), result.ticks);
    EXPECT_EQ(events.back().news["result"]["ticks"], result.ticks);
  }
  EXPECT_EQ(late.size(), 1U);
}

TEST(Server, GoesOnBehindTheLastEventThatABrowserHas) {
  Feed feed;
  Server server(kHere, 0, feed, "");
  server.start();
  const RunResult result = drive(short_run(), feed);
  const std::string id = listen(server.port()).back().id;
  const std::string middle = id.substr(0, id.find('/')) + "/321";
  const auto rest = listen(server.port(), middle);
  EXPECT_EQ(rest.front().news["from"], 321);
  EXPECT_EQ(ticks_of(rest), result.ticks);
  for (const char* nonsense : {"x", "/", "x/", "x/1x", "x/-1", "x/99999999999999999999"}) {
    EXPECT_EQ(ticks_of(listen(server.port(), nonsense)), result.ticks) << nonsense;
  }
}

TEST(Server, OneWhoReadsNothingKeepsNobodyWaiting) {
  Feed feed;
  auto server = std::make_unique<Server>(kHere, 0, feed, "");
  server->start();
  const Idle idle(server->port());
  EXPECT_FALSE(idle.read_some().empty());
  // More than the kernel buffers for a client that does not read.
  Scenario scenario = short_run();
  scenario.name.assign(8 << 20, 'x');
  const RunResult result = drive(scenario, feed);
  EXPECT_EQ(ticks_of(listen(server->port())), result.ticks);
  server.reset();
}

TEST(Server, OneWhoIsGoneIsForgotten) {
  Feed feed;
  feed.begin(setting(short_run()));
  Server server(kHere, 0, feed, "");
  server.start();
  for (int i = 0; i < 3 * Server::kMostWatchers; ++i) {
    // Each is accepted as soon as the server notices that earlier ones closed.
    std::string answer;
    while (answer.find(" 200 ") == std::string::npos) answer = Idle(server.port()).read_some();
    feed.say(std::to_string(i));
  }
}

TEST(Server, TooManyAreRefused) {
  Feed feed;
  feed.begin(setting(short_run()));
  Server server(kHere, 0, feed, "");
  server.start();
  std::vector<std::unique_ptr<Idle>> all;
  for (int i = 0; i < Server::kMostWatchers; ++i) {
    all.push_back(std::make_unique<Idle>(server.port()));
    EXPECT_THAT(all.back()->read_some(), HasSubstr(" 200 "));
  }
  EXPECT_THAT(Idle(server.port()).read_some(), HasSubstr(" 503 "));
  EXPECT_EQ(get(server.port(), "/").status, 200);
}

TEST(Server, APortHasOneServer) {
  const Feed feed;
  const Server server(kHere, 0, feed, "");
  EXPECT_GT(server.port(), 0);
  try {
    const Server other(kHere, server.port(), feed, "");
    ADD_FAILURE() << "two servers have the same port";
  } catch (const ServerError& e) {
    EXPECT_THAT(e.what(), HasSubstr(std::to_string(server.port()) + ": Address already in use"));
  }
}

TEST(Server, AnAddressOfNobodyIsRefused) {
  const Feed feed;
  EXPECT_THROW(Server("192.0.2.1", 0, feed, ""), ServerError);
  EXPECT_THROW(Server("no.such.name.invalid", 0, feed, ""), ServerError);
}

TEST(Server, MayEndBeforeItBegins) {
  const Feed feed;
  const Server never(kHere, 0, feed, "");
  Server at_once(kHere, 0, feed, "");
  at_once.start();
}

TEST(Names, OfThisComputerAlone) {
  for (const char* address : {"127.0.0.1", "localhost", "::1"}) {
    const Names names(address, 8765);
    for (const char* host : {"localhost:8765", "127.0.0.1:8765", "[::1]:8765", "LOCALHOST:8765"}) {
      EXPECT_TRUE(names.knows(host)) << address << " " << host;
    }
    for (const char* host :
         {"", ":", ":8765", "localhost", "localhost:", "localhost:8766", "[::1]", "::1:8765",
          "192.168.1.7:8765", "robot:8765", "localhost.evil.example:8765", "[::1]:8765:8765"}) {
      EXPECT_FALSE(names.knows(host)) << address << " " << host;
    }
  }
  EXPECT_TRUE(Names("127.0.0.5", 1).knows("127.0.0.5:1"));
}

TEST(Names, PortEightyNeedNotBeNamed) { EXPECT_TRUE(Names("127.0.0.1", 80).knows("localhost")); }

TEST(Names, WhereOthersReachItNumbersAreGoodAndForeignNamesAreNot) {
  const Names names("0.0.0.0", 8765);
  char own[256] = {};
  gethostname(own, sizeof own - 1);
  for (const std::string& host : {std::string("192.168.1.7"), std::string("[fe80::1]"),
                                  std::string("localhost"), std::string(own), std::string(own) + ".local"}) {
    EXPECT_TRUE(names.knows(host + ":8765")) << host;
    EXPECT_FALSE(names.knows(host + ":8766")) << host;
  }
  for (const char* host :
       {"evil.example:8765", "192.168.1.7.evil.example:8765", "[evil]:8765", "1.2.3:8765"}) {
    EXPECT_FALSE(names.knows(host)) << host;
  }
  EXPECT_TRUE(Names("robot.lan", 8765).knows("robot.lan:8765"));
  EXPECT_FALSE(Names("robot.lan", 8765).knows("other.lan:8765"));
}

TEST(Names, TheAddressOfThePage) {
  EXPECT_EQ(Names("127.0.0.1", 8765).url(), "http://127.0.0.1:8765/");
  EXPECT_EQ(Names("::1", 8765).url(), "http://[::1]:8765/");
}

Asked asked(const std::string& text) {
  Head head;
  const auto all = head.add(text);
  EXPECT_TRUE(all.has_value()) << text;
  return all.value_or(Asked{});
}

TEST(Head, IsTheSameInAnyPieces) {
  const std::string text =
      "GET /events?x=1 HTTP/1.1\r\nHost: here\r\nlast-event-id:\t a/7 \r\nORIGIN: "
      "http://here\r\nX:\r\n\r\nmore";
  const std::size_t end = text.find("more");
  for (std::size_t piece = 1; piece <= text.size(); ++piece) {
    Head head;
    std::optional<Asked> all;
    for (std::size_t at = 0; at < text.size() && !all; at += piece) {
      all = head.add(std::string_view(text).substr(at, piece));
      EXPECT_EQ(all.has_value(), at + piece >= end) << piece;
    }
    ASSERT_TRUE(all.has_value());
    EXPECT_EQ(all->status, 200);
    EXPECT_EQ(all->request.path, "/events");
    EXPECT_EQ(all->request.host, "here");
    EXPECT_EQ(all->request.last_event_id, "a/7");
    EXPECT_EQ(all->request.origin, "http://here");
  }
}

TEST(Head, MayBeSoLongAndNotLonger) {
  const std::string begin = "GET / HTTP/1.1\r\nHost: here\r\nX: ";
  for (const std::size_t length : {kMostHead, kMostHead + 1}) {
    const std::string text = begin + std::string(length - begin.size(), 'x') + "\r\n\r\n";
    EXPECT_EQ(asked(text).status, length > kMostHead ? 431 : 200);
    Head head;
    std::optional<Asked> all;
    for (std::size_t at = 0; at < text.size() && !all; ++at)
      all = head.add(std::string_view(text).substr(at, 1));
    ASSERT_TRUE(all.has_value());
    EXPECT_EQ(all->status, length > kMostHead ? 431 : 200);
  }
}

TEST(Head, OfNonsenseIsRefused) {
  const auto status = [](const std::string& text) { return asked(text + "\r\n\r\n").status; };
  for (const char* text :
       {"", "GET", "GET / HTTP/1.1", "GET / HTTP/1.1\r\n: x\r\nHost: a", "GET / HTTP/1.1\r\nHost : a",
        "GET here HTTP/1.1\r\nHost: a", "GET http://a/ HTTP/1.1\r\nHost: a",
        "GET / HTTP/1.1\r\nHost: a\r\nhost: b", "GET / HTTP/1.1\r\nHost: a\r\nOrigin: b\r\nOrigin: c",
        "GET /  HTTP/1.1\r\nHost: a"}) {
    EXPECT_EQ(status(text), 400) << text;
  }
  EXPECT_EQ(status("PUT / HTTP/1.1\r\nHost: a"), 405);
  EXPECT_EQ(status("GET / HTTP/3\r\nHost: a"), 505);
  EXPECT_EQ(status("GET / HTTP/1.0\r\nHost: a"), 200);
}

}  // namespace
}  // namespace whisker::view
