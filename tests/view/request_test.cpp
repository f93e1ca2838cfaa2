#include "host/view/request.hpp"

#include <gtest/gtest.h>

namespace whisker::view {
namespace {

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
