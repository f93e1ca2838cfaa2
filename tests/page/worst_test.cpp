#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/page/page.hpp"

namespace whisker::page {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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
