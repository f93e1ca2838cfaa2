// Hostile clients of the server, which runs in the process that drives the plant.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "host/lab/view/server.hpp"
#include "tests/view/http.hpp"
#include "tests/view/watched.hpp"

namespace whisker::view {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Answer;
using testing::answer_of;
using testing::ask;
using testing::get;
using ::testing::HasSubstr;
using testing::kHere;
using testing::Line;
using testing::setting;
using testing::short_run;

/// The targets of a process's file descriptors.
std::set<std::string> open_files(pid_t process) {
  std::set<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd")) {
    std::error_code gone;
    all.insert(std::filesystem::read_symlink(entry, gone).string());
  }
  return all;
}

/// A server of an endless run.
class Hostile : public ::testing::Test {
 protected:
  Hostile() {
    feed_.begin(setting(short_run()));
    server_.start();
  }
  int port() const { return server_.port(); }

  const std::set<std::string> before_ = open_files(getpid());
  Feed feed_;
  Server server_{kHere, 0, feed_, "<p>page</p>"};
};

/// Resident memory of this process, kB.
long resident() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmRSS:", 0) == 0) return std::stol(line.substr(6));
  }
  return 0;
}

TEST_F(Hostile, AHeaderOfAMegabyteIsCutOff) {
  const Line line(port());
  line.send(ask(port(), "/"));
  line.send("Cookie: " + std::string(1 << 20, 'x'));
  const Answer answer = answer_of(line.read_all());
  EXPECT_EQ(answer.status, 431);
  EXPECT_THAT(answer.body, HasSubstr("16 kB"));
}

TEST_F(Hostile, ManyShortHeadersAreCutOffToo) {
  const Line line(port());
  line.send(ask(port(), "/"));
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "X-" + std::to_string(i) + ": x\r\n";
  line.send(many);
  EXPECT_EQ(answer_of(line.read_all()).status, 431);
}

TEST_F(Hostile, AHeaderWithoutAnEndTakesNoMemory) {
  const long before = resident();
  const std::string block(1 << 20, 'x');
  std::vector<std::future<std::size_t>> all;
  for (int i = 0; i < 8; ++i) {
    all.push_back(std::async(std::launch::async, [&] {
      const Line line(port());
      line.send("GET / HTTP/1.1\r\nX: ");
      std::size_t taken = 0;
      for (int k = 0; k < 32; ++k) taken += line.send(block);
      return taken;
    }));
  }
  for (auto& one : all) one.wait();
  EXPECT_LT(resident() - before, 16 << 10) << "kB more than before";
  EXPECT_EQ(get(port(), "/").status, 200);
}

TEST_F(Hostile, SixtyWhoAskSlowlyStopNobody) {
  std::vector<std::unique_ptr<Line>> slow;
  for (int i = 0; i < 60; ++i) {
    slow.push_back(std::make_unique<Line>(port()));
    slow.back()->send("GET / HT");
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(get(port(), "/").status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(1));
}

TEST_F(Hostile, ThreeHundredWhoSayNothingStopNobody) {
  std::vector<std::unique_ptr<Line>> idle;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 300; ++i) idle.push_back(std::make_unique<Line>(port()));
  EXPECT_EQ(get(port(), "/").status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(5));
}

TEST_F(Hostile, ARequestHasAnEndHoweverOftenAByteComes) {
  const Line line(port());
  line.send("GET / HTTP/1.1\r\nX: ");
  bool left = false;
  for (int i = 0; i < 60 && !left; ++i) {
    line.send("x");
    left = line.is_left(milliseconds(100));
  }
  EXPECT_TRUE(left) << "six seconds, and it still listens";
}

TEST_F(Hostile, WhoTakesThePageSlowlyIsLetGo) {
  Server large(kHere, 0, feed_, std::string(16 << 20, 'x'));
  large.start();
  const Line line(large.port(), 4096);
  line.send(ask(large.port(), "/") + "\r\n");
  std::size_t taken = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < seconds(11)) {
    taken += line.read_some().size();
    std::this_thread::sleep_for(milliseconds(100));
  }
  // After that, only the data that the kernel still buffers arrives.
  EXPECT_LT(taken + line.read_all().size(), std::size_t{16} << 20);
}

TEST_F(Hostile, AnotherNameThanItsOwnIsRefused) {
  const std::string own = std::to_string(port());
  for (const std::string& host :
       {"127.0.0.1:" + own, "localhost:" + own, "LocalHost:" + own, "[::1]:" + own}) {
    EXPECT_EQ(get(port(), "/", "Host: " + host + "\r\n").status, 200) << host;
  }
  for (const std::string& host :
       {"evil.example:" + own, std::string("evil.example"), std::string("127.0.0.1"),
        std::string("127.0.0.1:1"), "127.0.0.1.evil.example:" + own, "localhost:" + own + "1",
        "10.0.0.1:" + own, ":" + own, "localhost:" + own + "@evil.example"}) {
    for (const char* path : {"/", "/events"}) {
      const Answer answer = get(port(), path, "Host: " + host + "\r\n");
      EXPECT_EQ(answer.status, 421) << host;
      EXPECT_THAT(answer.body, HasSubstr("http://127.0.0.1:" + own + "/"));
    }
  }
}

TEST_F(Hostile, AnotherSitesPageIsRefused) {
  const std::string own = "http://127.0.0.1:" + std::to_string(port());
  const auto from = [&](const std::string& origin) {
    return get(port(), "/", "Origin: " + origin + "\r\n").status;
  };
  EXPECT_EQ(from(own), 200);
  for (const std::string& origin :
       {std::string("http://evil.example"), std::string("null"), std::string("http://127.0.0.1:1"), own + "1",
        "https" + own.substr(4), "http://localhost:" + std::to_string(port())}) {
    EXPECT_EQ(from(origin), 403) << origin;
  }
}

TEST_F(Hostile, WhatIsNoRequestIsRefused) {
  const std::string host = "Host: 127.0.0.1:" + std::to_string(port()) + "\r\n";
  const auto status = [&](const std::string& text) {
    const Line line(port());
    line.send(text + "\r\n");
    return answer_of(line.read_all()).status;
  };
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host), 200);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n"), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + host), 400);
  EXPECT_EQ(status("GET /\r\n" + host), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nno colon\r\n" + host), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n folded\r\n" + host), 400);
  EXPECT_EQ(status("POST / HTTP/1.1\r\n" + host), 405);
  EXPECT_EQ(status("GET / HTTP/2.0\r\n" + host), 505);
}

TEST_F(Hostile, AProgramStartedAfterwardsInheritsNoSocket) {
  const Line line(port());
  line.send(ask(port(), "/events") + "\r\n");
  ASSERT_THAT(line.read_some(), HasSubstr(" 200 "));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execlp("sleep", "sleep", "60", static_cast<char*>(nullptr));
    _exit(1);
  }
  const auto name = [&] {
    std::string text;
    std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), text);
    return text;
  };
  for (int i = 0; i < 1000 && name() != "sleep"; ++i) std::this_thread::sleep_for(milliseconds(5));
  const std::set<std::string> files = open_files(child);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  for (const std::string& file : files) {
    EXPECT_TRUE(file.rfind("socket:", 0) != 0 || before_.count(file) > 0) << file;
  }
}

TEST_F(Hostile, WhoComesWhenAllSeatsAreTakenIsToldSo) {
  std::vector<std::unique_ptr<Line>> all;
  for (int i = 0; i < Server::kMostWatchers; ++i) {
    all.push_back(std::make_unique<Line>(port()));
    all.back()->send(ask(port(), "/events") + "\r\n");
    EXPECT_THAT(all.back()->read_some(), HasSubstr(" 200 "));
  }
  const Answer answer = get(port(), "/events");
  EXPECT_EQ(answer.status, 503);
  EXPECT_THAT(answer.body, HasSubstr("24 watch this run already"));
  EXPECT_NE(answer.header("Retry-After"), "");
  EXPECT_EQ(get(port(), "/").status, 200);
  all.clear();
  Answer again;
  for (int i = 0; i < 100 && again.status != 200; ++i) {
    const Line line(port());
    line.send(ask(port(), "/events") + "\r\n");
    again = answer_of(line.read_some());
    std::this_thread::sleep_for(milliseconds(50));
  }
  EXPECT_EQ(again.status, 200);
}

}  // namespace
}  // namespace whisker::view
