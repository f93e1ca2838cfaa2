
#include <gtest/gtest.h>

#include <string>

#include "host/campaign/row_file.hpp"
#include "host/scenario/error.hpp"
#include "tests/campaign/rows.hpp"

namespace whisker::campaign {
namespace {

std::string line(std::uint64_t seed, const std::string& world = "discs",
                 const std::string& planner = "thesis") {
  Row row;
  row.seed = seed;
  row.world = world;
  row.planner = planner;
  return to_csv(row) + "\n";
}

const std::string kHead = std::string(kRowHeader) + "\n";

class Merge : public ::testing::Test {
 protected:
  std::string complaint(const std::vector<std::string>& files) {
    try {
      merged(files);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  Folder folder_;
};

TEST_F(Merge, PutsTheMissionsInOrderWhereverTheyStand) {
  const std::string a = folder_.file("a.csv", kHead + line(10) + line(3) + kHead + line(2, "maze"));
  const std::string b = folder_.file("b.csv", kHead + line(9) + line(3, "discs", "other"));
  std::string order;
  for (const Row& row : merged({a, b}))
    order += row.world + " " + row.planner + " " + std::to_string(row.seed) + "; ";
  EXPECT_EQ(order, "discs other 3; discs thesis 3; discs thesis 9; discs thesis 10; maze thesis 2; ");
}

TEST_F(Merge, AMissionThatIsThereTwiceIsRefusedWithBothPlaces) {
  const std::string a = folder_.file("a.csv", kHead + line(1) + line(2));
  const std::string b = folder_.file("b.csv", kHead + line(3) + line(2));
  EXPECT_EQ(complaint({a, b}), b + ":3:1: seed 2 is there already, in " + a + ":3");
  EXPECT_EQ(complaint({a, a}), a + ":2:1: seed 1 is there already, in " + a + ":2");
}

TEST_F(Merge, AWrongFileIsRefusedWithItsLine) {
  const std::string good = folder_.file("good.csv", kHead + line(1));
  const auto refused = [&](const std::string& text) {
    const std::string file = folder_.file("bad.csv", text);
    const std::string words = complaint({good, file});
    return words.rfind(file, 0) == 0 ? words.substr(file.size()) : "not about the file: " + words;
  };
  EXPECT_EQ(refused(""), ":1:1: empty: not even the header of a campaign");
  EXPECT_EQ(refused(line(2)).substr(0, 40), ":1:1: not the header of a campaign: seed");
  EXPECT_EQ(refused(kHead + line(2) + "x" + line(3)), ":3:1: column seed: 'x3' is no such number");
  EXPECT_EQ(refused(kHead + line(2) + "\n"), ":3:1: column seed: '' is no such number");
  EXPECT_EQ(refused(kHead + line(2) + "4,gave"), ":3:1: the last line is cut off: it has no end of line");
  EXPECT_EQ(complaint({folder_.path("none.csv")}),
            folder_.path("none.csv") + ":1:1: No such file or directory");
  EXPECT_EQ(complaint({folder_.path("")}), folder_.path("") + ":1:1: cannot be read");
}

// Written by an older `whisker campaign`, which reported a wrong belief as `reached`.
TEST_F(Merge, RowsFromBeforeOffGoalAreJudgedByTheirTruePlace) {
  const std::string old = std::string(WHISKER_SOURCE_DIR) + "/tests/campaign/old_rows.csv";
  int reached = 0, off = 0, other = 0;
  for (const Row& row : merged({old})) {
    EXPECT_FALSE(row.believed_distance_m);
    EXPECT_EQ(row.verdict == Verdict::off_goal, row.final_distance_m > 0.1 && row.detail == "at_goal");
    ++(row.verdict == Verdict::reached ? reached : row.verdict == Verdict::off_goal ? off : other);
  }
  EXPECT_EQ(reached, 2);
  EXPECT_EQ(off, 5);
  EXPECT_EQ(other, 1);
  const std::string both = folder_.file("both.csv", text_of(old) + kHead + line(99999, "maze"));
  EXPECT_EQ(merged({both}).size(), 9U);
  const std::string mixed = folder_.file("mixed.csv", text_of(old) + line(99999, "maze"));
  EXPECT_EQ(complaint({mixed}), mixed + ":10:1: the row is not one that campaign writes");
}

TEST_F(Merge, HeadersAloneHaveNothingToSumUp) {
  const std::string empty = folder_.file("empty.csv", kHead);
  EXPECT_EQ(complaint({empty, empty}), empty + ":1:1: no mission in it");
  EXPECT_EQ(merged({empty, folder_.file("one.csv", kHead + line(1))}).size(), 1U);
}

}  // namespace
}  // namespace whisker::campaign
