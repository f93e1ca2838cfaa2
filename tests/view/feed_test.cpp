#include "host/lab/view/feed.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "host/lab/page/json.hpp"
#include "tests/view/watched.hpp"

namespace whisker::view {
namespace {

using nlohmann::json;
using testing::drive;
using testing::setting;
using testing::short_run;

/// The next news, which must exist.
json next(const Feed& feed, Place& place) {
  const auto news = feed.news(place);
  EXPECT_TRUE(news.has_value());
  return news ? json::parse(*news) : json();
}

std::size_t ticks_of(const json& news) { return news["columns"][0][3].get<std::size_t>(); }

/// Reads the feed, and checks that every tick comes once and in order.
class Listener {
 public:
  explicit Listener(const Feed& feed) : feed_(feed) {}

  void listen() {
    const auto text = feed_.news(place_);
    if (!text) return;
    news_ = json::parse(*text);
    EXPECT_EQ(news_["from"], ticks_);
    EXPECT_EQ(news_.contains("setting"), !begun_);
    begun_ = true;
    ticks_ += ticks_of(news_);
  }
  std::size_t ticks() const { return ticks_; }
  const json& last() const { return news_; }
  bool over() const { return feed_.over(place_); }

 private:
  const Feed& feed_;
  Place place_;
  json news_;
  std::size_t ticks_ = 0;
  bool begun_ = false;
};

TEST(Feed, TellsNothingBeforeARunBegins) {
  const Feed feed;
  Place place;
  EXPECT_FALSE(feed.news(place).has_value());
  EXPECT_FALSE(feed.over(place));
}

TEST(Feed, TellsTheSettingFirst) {
  Feed feed;
  feed.begin({short_run(), {}, 99, false});
  Place place;
  const json news = next(feed, place);
  EXPECT_EQ(news["setting"]["name"], "short");
  EXPECT_EQ(news["setting"]["planner"], nullptr);
  EXPECT_EQ(news["setting"]["inside"], false);
  EXPECT_EQ(news["setting"]["seed"], 99);
  EXPECT_EQ(ticks_of(news), 0U);
  EXPECT_EQ(news["ended"], false);
  EXPECT_EQ(news["result"], nullptr);
  EXPECT_FALSE(feed.news(place).has_value());
}

TEST(Feed, EveryoneIsToldEveryTickOnceAtAPaceOfTheirOwn) {
  Feed feed;
  Listener eager(feed), lazy(feed), late(feed);
  std::size_t ticks = 0;
  const RunResult result = drive(short_run(), feed, [&](const Moment&) {
    if (++ticks % 3 == 0) eager.listen();
    if (ticks % 301 == 0) lazy.listen();
  });
  ASSERT_GT(result.ticks, 600U);
  for (Listener* const one : {&eager, &lazy, &late}) {
    EXPECT_FALSE(one->over());
    one->listen();
    EXPECT_EQ(one->ticks(), result.ticks);
    EXPECT_TRUE(one->over());
    EXPECT_EQ(one->last()["ended"], true);
    EXPECT_EQ(one->last()["result"]["ticks"], result.ticks);
  }
  EXPECT_EQ(late.last()["from"], 0);
}

/// The ticks of `all` from this one on.
Ticks behind(const Ticks& all, std::size_t from) {
  Ticks ticks;
  ticks.append(all, from, 0);
  return ticks;
}

TEST(Feed, TheColumnsAreThoseOfTheTicks) {
  Feed feed;
  const Scenario scenario = short_run();
  RunLog log({scenario});
  Place place;
  std::size_t pictures = 0;
  drive(scenario, feed, [&](const Moment& moment) {
    log.add(moment);
    // Between the ends of the feed's parts, at them and after them.
    const std::size_t ticks = log.ticks().records.size();
    if (ticks != 1 && ticks != 100 && ticks % 256 > 1 && ticks % 256 < 255) return;
    const std::size_t from = place.next;
    const json news = next(feed, place);
    const page::Packed expected = page::packed(behind(log.ticks(), from));
    EXPECT_EQ(news["data"], expected.data) << ticks;
    EXPECT_EQ(news["columns"].dump(), json::parse(expected.list.dump()).dump());
    pictures += behind(log.ticks(), from).frames.ticks.size();
  });
  EXPECT_GT(pictures, 100U);
}

TEST(Feed, TellsTheEdgesThatThePageOfTheRunHas) {
  Feed feed;
  Scenario scenario = short_run();
  scenario.walls = {{{0.5, -0.6}, {0.5, 0.6}}};
  scenario.time_limit_s = 60;
  std::vector<TickRecord> records;
  drive(scenario, feed, [&](const Moment& moment) { records.push_back(moment.record); });
  report::EncounterFinder finder;
  for (const TickRecord& r : records) finder.add(r);
  ASSERT_FALSE(finder.found().empty());
  Place place;
  EXPECT_EQ(next(feed, place)["edges"].dump(), json::parse(page::edges_data(finder.found()).dump()).dump());
}

TEST(Feed, TellsALongRunInPartsThatAreEachTrue) {
  Feed feed;
  Scenario scenario = short_run();
  scenario.walls = {{{0.5, -0.6}, {0.5, 0.6}}};
  scenario.goal.at = {60, 0.3};
  scenario.time_limit_s = 120;
  const RunResult result = drive(scenario, feed);
  ASSERT_GT(result.ticks, 10000U);
  Place place;
  std::size_t ticks = 0, parts = 0;
  for (auto news = feed.news(place); news; news = feed.news(place), ++parts) {
    const json part = json::parse(*news);
    EXPECT_EQ(part["from"], ticks);
    ticks += ticks_of(part);
    EXPECT_LT(ticks_of(part), 17U * 256U);
    EXPECT_EQ(part["ended"], ticks == result.ticks);
    EXPECT_EQ(part["result"].is_null(), ticks < result.ticks);
    for (const json& edge : part["edges"]) {
      EXPECT_LT(edge["hit"].get<std::size_t>(), ticks);
      EXPECT_TRUE(edge["left"].is_null() || edge["left"].get<std::size_t>() < ticks);
      EXPECT_EQ(edge["left"].is_null(), edge["end"] == "none");
    }
  }
  EXPECT_EQ(ticks, result.ticks);
  EXPECT_GE(parts, 3U);
}

TEST(Feed, GoesOnWhereABrokenLineEnded) {
  Feed feed;
  drive(short_run(), feed);
  Place before;
  const std::string name = next(feed, before)["run"];
  Place again{name, 500};
  const json rest = next(feed, again);
  EXPECT_EQ(rest["from"], 500);
  EXPECT_FALSE(rest.contains("setting"));
  EXPECT_EQ(ticks_of(rest), before.next - 500);
  Place nowhere{name, before.next + 1};
  EXPECT_EQ(next(feed, nowhere)["from"], 0);
  Place stranger{"another", 500};
  const json all = next(feed, stranger);
  EXPECT_EQ(all["from"], 0);
  EXPECT_TRUE(all.contains("setting"));
}

TEST(Feed, ARunThatBeginsAnewIsAnotherOne) {
  Feed feed;
  const Scenario scenario = short_run();
  drive(scenario, feed);
  Place place;
  const std::string first = next(feed, place)["run"];
  feed.begin(setting(scenario));
  const json news = next(feed, place);
  EXPECT_NE(news["run"], first);
  EXPECT_TRUE(news.contains("setting"));
  EXPECT_EQ(ticks_of(news), 0U);
  EXPECT_TRUE(news["edges"].empty());
}

TEST(Feed, SaysWhatItWaitsForAndThatItIsOver) {
  Feed feed;
  feed.begin(setting(short_run()));
  Place place;
  next(feed, place);
  feed.say("waits for the controller");
  EXPECT_EQ(next(feed, place)["says"], "waits for the controller");
  feed.say("");
  EXPECT_EQ(next(feed, place)["says"], "");
  EXPECT_FALSE(feed.over(place));
  feed.close();
  EXPECT_FALSE(feed.over(place));
  const json last = next(feed, place);
  EXPECT_EQ(last["ended"], true);
  EXPECT_EQ(last["result"], nullptr);
  EXPECT_TRUE(feed.over(place));
}

TEST(Feed, AVerdictStaysWhenItCloses) {
  Feed feed;
  const RunResult result = drive(short_run(), feed);
  feed.close();
  Place place;
  EXPECT_EQ(next(feed, place)["result"]["ticks"], result.ticks);
}

TEST(Feed, ManyListenWhileOneDrives) {
  Feed feed;
  feed.begin(setting(short_run()));
  std::vector<std::size_t> ticks(4);
  std::vector<std::thread> threads;
  for (std::size_t& heard : ticks) {
    threads.emplace_back([&feed, &heard] {
      Place place;
      while (!feed.over(place)) {
        const auto news = feed.news(place);
        if (news) heard += ticks_of(json::parse(*news));
      }
    });
  }
  RunOptions options;
  options.watch = [&feed](const Moment& moment) { feed.add(moment); };
  const RunResult result = run(short_run(), options);
  feed.end(result);
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t heard : ticks) EXPECT_EQ(heard, result.ticks);
}

}  // namespace
}  // namespace whisker::view
