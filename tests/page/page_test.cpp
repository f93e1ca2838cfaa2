#include "host/lab/page/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <zlib.h>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/harness/run/runner.hpp"
#include "host/lab/page/base64.hpp"
#include "host/lab/page/columns.hpp"
#include "host/lab/page/deflate.hpp"
#include "host/lab/page/template.hpp"

namespace whisker::page {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Scenario short_run() {
  Scenario s;
  s.name = "</script><b>\"one\" & \xc3\xa9";
  s.goal.at = {1, 0.3};
  s.discs = {{{0.5, 0.2}, 0.05}};
  s.time_limit_s = 8;
  return s;
}

Controller controller() {
  Controller c;
  c.d = {"D", "ahead", 0, 10, {{"VS", 1}, {"VB", 9}}};
  c.r = {"R", "sides", -8, 8, {{"RVB", -7}, {"LVB", 7}}};
  c.sa = {"SA", "turn", -1.5, 1.5, {{"TRVB", -1.5}, {"TLVB", 1.5}}};
  c.sd = {"SD", "step", 0, 2, {{"VS", 0.3}, {"VB", 1.7}}};
  c.turn = c.step = {{{"Z", 0}, {"Z", 0}}, {{"Z", 0}, {"Z", 0}}};
  c.sa_at = [](double d, double r) { return 0.01 * d + 0.001 * r; };
  c.sd_at = [](double, double) { return 1.0; };
  c.d_nodes = {1, 9};
  c.r_nodes = {-7, 7};
  return c;
}

StoredRun watched(const Scenario& scenario, RunResult& result) {
  RunOptions options;
  RunLog log({scenario, options.planner, 77});
  log.watch(options);
  result = run(scenario, options);
  log.end(result);
  return stored(log);
}

/// The content of the element with this id.
std::string content(const std::string& page, const std::string& id) {
  const std::size_t open = page.find(" id=\"" + id + "\">");
  if (open == std::string::npos) return {};
  const std::size_t from = page.find('>', open) + 1;
  return page.substr(from, page.find("</script>", from) - from);
}

TEST(Template, HasOnePlaceForDataAndIsPlainAscii) {
  std::string page;
  for (const std::string_view part : template_parts()) page += part;
  EXPECT_EQ(page.find(kDataMark), page.rfind(kDataMark));
  EXPECT_NE(page.find(kDataMark), std::string::npos);
  for (const char c : page) ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
  EXPECT_THAT(page, Not(HasSubstr("http://localhost")));
  EXPECT_LT(page.size(), 160000U);
}

TEST(Page, HoldsTheRunWhateverItsNameIs) {
  const Scenario scenario = short_run();
  RunResult result;
  const StoredRun run = watched(scenario, result);
  const std::string page = run_page(run, controller());
  const auto data = nlohmann::json::parse(content(page, "data"));
  EXPECT_EQ(data["format"], 1);
  EXPECT_EQ(data["runs"][0]["name"], scenario.name);
  EXPECT_EQ(data["runs"][0]["seed"], 77);
  EXPECT_EQ(data["runs"][0]["result"]["ticks"], result.ticks);
  EXPECT_EQ(data["runs"][0]["columns"][0], nlohmann::json({"t_s", 2, 1000, result.ticks}));
  EXPECT_EQ(data["shared"]["modes"].size(), static_cast<std::size_t>(planning::kModes));
  EXPECT_EQ(data["shared"]["whys"].size(), static_cast<std::size_t>(planning::kWhys));
  EXPECT_EQ(content(page, "columns-0"), run.columns);
  EXPECT_FALSE(data.contains("campaign"));
}

TEST(Page, SamplesTheControllerRowByRow) {
  RunResult result;
  const std::string page = run_page(watched(short_run(), result), controller());
  const auto data = nlohmann::json::parse(content(page, "data"));
  const auto& samples = data["shared"]["controller"]["sa_thousandths"];
  ASSERT_EQ(samples.size(), 41U * 65U);
  EXPECT_EQ(samples[0], -8);
  EXPECT_EQ(samples[64], 8);
  EXPECT_EQ(samples[40 * 65 + 32], 100);
}

TEST(Page, OfACampaignHasItsRowsAndReplays) {
  RunResult result;
  const StoredRun run = watched(short_run(), result);
  campaign::Row row;
  row.seed = 5;
  row.verdict = Verdict::contact;
  row.world = "discs --noise";
  row.planner = "skirt";
  const std::string page = campaign_page({row, row}, {{1, run}, {0, run}}, controller());
  const auto data = nlohmann::json::parse(content(page, "data"));
  EXPECT_EQ(data["campaign"]["summary"]["missions"], 2);
  ASSERT_EQ(data["campaign"]["rows"].size(), 2U);
  EXPECT_EQ(data["campaign"]["rows"][0].size(), data["campaign"]["fields"].size());
  EXPECT_EQ(data["campaign"]["rows"][0][1], "contact");
  EXPECT_EQ(data["runs"][0]["row"], 1);
  EXPECT_THAT(data["runs"][1]["command"].get<std::string>(), HasSubstr("--replay 5"));
  EXPECT_EQ(content(page, "columns-1"), run.columns);
}

TEST(Page, OfACampaignSaysHowToDriveWhatItHasNoRoomFor) {
  RunResult result;
  campaign::Row good, bad;
  good.seed = 5;
  good.world = bad.world = "discs";
  good.planner = bad.planner = "skirt";
  good.verdict = Verdict::reached;
  bad.seed = 6;
  bad.verdict = Verdict::contact;
  const std::string page = campaign_page({good, bad}, {{1, watched(short_run(), result)}}, controller());
  const auto campaign = nlohmann::json::parse(content(page, "data"))["campaign"];
  EXPECT_EQ(campaign["order"], nlohmann::json({1, 0}));
  EXPECT_THAT(campaign["commands"][0].get<std::string>(), HasSubstr("--replay 5"));
  EXPECT_TRUE(campaign["commands"][1].is_null());
}

TEST(Page, SaysHowLargeTheMapIs) {
  const Scenario scenario = short_run();
  const auto map_of = [&](std::optional<PlannerKind> planner) {
    return nlohmann::json::parse(stored(RunLog({scenario, planner, 1})).json)["map"];
  };
  EXPECT_TRUE(map_of(PlannerKind::boundary).is_null());
  EXPECT_TRUE(map_of(std::nullopt).is_null());
  const nlohmann::json expected = {{"bytes", 1024}, {"columns", 32}, {"rows", 48}, {"cell", 0.125}};
  EXPECT_EQ(map_of(core_planner("map", 1024)), expected);
}

TEST(RunLog, ChangesNothingAboutTheRun) {
  RunResult result;
  watched(short_run(), result);
  EXPECT_EQ(result.hash, run(short_run()).hash);
}

TEST(RunLog, HasAllTicksAndAFrameEveryFiftyMilliseconds) {
  const Scenario scenario = short_run();
  RunLog log({scenario});
  RunOptions options;
  log.watch(options);
  const RunResult result = run(scenario, options);
  EXPECT_EQ(log.ticks().records.size(), result.ticks);
  EXPECT_EQ(log.ticks().health.size(), result.ticks);
  ASSERT_GT(log.ticks().frames.ticks.size(), 2U);
  for (std::size_t i = 0; i < log.ticks().frames.ticks.size(); ++i) {
    EXPECT_EQ(log.ticks().frames.ticks[i], static_cast<std::int64_t>(5 * i));
  }
}

TEST(RunLog, CoarseHasFiveTicksASecondAndTheLast) {
  const Scenario scenario = short_run();
  RunLog full({scenario}), coarse({scenario}, Detail::coarse);
  RunOptions options;
  options.planner = PlannerKind::boundary;
  full.watch(options);
  coarse.watch(options);
  const RunResult result = run(scenario, options);
  full.end(result);
  coarse.end(result);
  const std::vector<TickRecord>& all = full.ticks().records;
  const std::vector<TickRecord>& some = coarse.ticks().records;
  ASSERT_EQ(all.size(), result.ticks);
  ASSERT_EQ(some.size(), (all.size() - 1) / 20 + 1 + ((all.size() - 1) % 20 != 0 ? 1 : 0));
  EXPECT_EQ(coarse.ticks().health.size(), some.size());
  for (std::size_t i = 0; i + 1 < some.size(); ++i) EXPECT_EQ(some[i].t_s, all[20 * i].t_s);
  EXPECT_EQ(some.back().t_s, all.back().t_s);
  const std::vector<std::int64_t>& frames = coarse.ticks().frames.ticks;
  ASSERT_GT(frames.size(), 2U);
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i], static_cast<std::int64_t>(5 * i));
  EXPECT_LT(stored(coarse).columns.size() * 5, stored(full).columns.size());
}

/// The column's numbers, decoded as the header states.
std::vector<std::int64_t> read(const std::string& bytes, Order order) {
  std::vector<std::int64_t> values;
  std::int64_t last = 0, difference = 0;
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint64_t raw = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes[i++]);
      raw |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) break;
    }
    const auto half = static_cast<std::int64_t>(raw >> 1U);
    const std::int64_t written = (raw & 1U) != 0 ? -half - 1 : half;
    if (order == Order::values) last = written;
    if (order == Order::differences) last += written;
    if (order == Order::second_differences) last += difference += written;
    values.push_back(last);
  }
  return values;
}

RC_GTEST_PROP(Columns, AreReadBackAsTheyWere, ()) {
  constexpr std::int64_t kMost = std::int64_t{1} << 50;
  const auto values = *rc::gen::container<std::vector<std::int64_t>>(
      rc::gen::oneOf(rc::gen::inRange<std::int64_t>(-200, 200), rc::gen::inRange(-kMost, kMost + 1)));
  for (const Order order : {Order::values, Order::differences, Order::second_differences}) {
    Columns columns;
    columns.add("x", order, 1000, values);
    RC_ASSERT(read(columns.bytes(), order) == values);
    RC_ASSERT(columns.list().back().count == values.size());
  }
}

TEST(Columns, AreAsTheHeaderSays) {
  Columns columns;
  columns.add("plain", Order::values, 1, {0, -1, 1, -2, 64});
  EXPECT_EQ(columns.bytes(), std::string("\x00\x01\x02\x03\x80\x01", 6));
  columns.add("line", Order::second_differences, 10, {5, 10, 15, 20});
  EXPECT_EQ(columns.bytes().substr(6), std::string("\x0a\x00\x00\x00", 4));
}

TEST(Columns, AnEvenMotionIsAByteATick) {
  std::vector<std::int64_t> even;
  for (std::int64_t i = 0; i < 1000; ++i) even.push_back(1000000 + 2700 * i);
  Columns columns;
  columns.add("x_m", Order::second_differences, 1000000, even);
  EXPECT_LT(columns.bytes().size(), 1010U);
}

TEST(Base64, GivesTheVectorsOfTheRfc) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

RC_GTEST_PROP(Deflate, IsUndoneByZlib, (const std::string& text)) {
  std::string out(text.size() + 1, '\0');
  const std::string small = deflated(text);
  uLongf size = static_cast<uLongf>(out.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(small.data()),
                 static_cast<uLong>(small.size()));
  RC_ASSERT(status == Z_OK);
  out.resize(size);
  RC_ASSERT(out == text);
}

TEST(Deflate, MakesARowOfZerosSmall) { EXPECT_LT(deflated(std::string(100000, '\0')).size(), 200U); }

campaign::Row row(Verdict verdict, double path_m) {
  campaign::Row r;
  r.verdict = verdict;
  r.path_m = path_m;
  r.shortest_m = 10;
  r.world = "discs";
  return r;
}

TEST(Worst, ContactsThenFaultsThenFailuresThenLongWays) {
  const std::vector<campaign::Row> rows = {row(Verdict::reached, 11),     row(Verdict::gave_up, 50),
                                           row(Verdict::reached, 30),     row(Verdict::contact, 3),
                                           row(Verdict::unreachable, 60), row(Verdict::fault, 2),
                                           row(Verdict::reached, 30)};
  EXPECT_THAT(worst(rows, 99), ElementsAre(3, 5, 4, 1, 2, 6, 0));
  EXPECT_THAT(worst(rows, 2), ElementsAre(3, 5));
  EXPECT_THAT(worst(rows, 0), IsEmpty());
}

TEST(Worst, BeforeLongWaysComeThoseThatOnlyBelieveToBeThereTheFarthestOffFirst) {
  std::vector<campaign::Row> rows = {row(Verdict::reached, 90), row(Verdict::off_goal, 50),
                                     row(Verdict::off_goal, 12), row(Verdict::gave_up, 20)};
  rows[1].final_distance_m = 0.2;
  rows[2].final_distance_m = 5.8;
  EXPECT_THAT(worst(rows, 99), ElementsAre(3, 2, 1, 0));
}

TEST(Worst, UnreachableIsNoFailureWhereThereIsNoWay) {
  std::vector<campaign::Row> rows = {row(Verdict::unreachable, 40), row(Verdict::reached, 12)};
  rows[0].shortest_m.reset();
  rows[0].world = "enclosed";
  EXPECT_THAT(worst(rows, 2), ElementsAre(1, 0));
}

}  // namespace
}  // namespace whisker::page
