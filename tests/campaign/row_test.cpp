#include "host/lab/campaign/row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "host/lab/campaign/motion_count.hpp"
#include "host/lab/campaign/row_file.hpp"
#include "tests/campaign/rows.hpp"

namespace whisker::campaign {
namespace {

const std::string kLine =
    "7,reached,12.500000,2.000000,3.100000,1,2,3,0.050000,0.010000,0.020000,1,1.600000,1.250000,7.812500,"
    "1250,"
    "00000000000000ff,at_goal,thesis,,discs --noise,0.080000,1,5,60";
/// The same row in the older formats.
const std::string kJudgedLine = kLine.substr(0, kLine.find(",5,60"));
const std::string kOldLine = kLine.substr(0, kLine.find(",0.080000,1"));

std::string complaint(const std::string& line) {
  try {
    parse_row(line);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

std::string with(const std::string& from, const std::string& to) {
  std::string line = kLine;
  return line.replace(line.find(from), from.size(), to);
}

TEST(Row, FiguresThatFollowFromOthers) {
  Row row = parse_row(kLine);
  EXPECT_EQ(ratio(row), 1.25);
  EXPECT_EQ(s_per_m(row), 7.8125);
  row.shortest_m.reset();
  EXPECT_FALSE(ratio(row));
  EXPECT_FALSE(s_per_m(row));
}

TEST(Row, SuccessIsReachedWhereThereIsAWayAndUnreachableWhereThereIsNone) {
  Row row;
  for (const char* world : {"discs", "maze", "enclosed.toml", "enclosed 2/a.toml", "enclosedness"}) {
    row.world = world;
    row.verdict = Verdict::reached;
    EXPECT_TRUE(succeeded(row)) << world;
    EXPECT_TRUE(truly_there(row)) << world;
    row.verdict = Verdict::off_goal;
    EXPECT_TRUE(succeeded(row)) << world << ": as far as the robot can know";
    EXPECT_FALSE(truly_there(row)) << world;
    row.verdict = Verdict::unreachable;
    EXPECT_FALSE(succeeded(row)) << world;
  }
  for (const char* world : {"enclosed", "enclosed --discs 20 --box"}) {
    row.world = world;
    EXPECT_TRUE(succeeded(row)) << world;
    row.verdict = Verdict::gave_up;
    EXPECT_FALSE(succeeded(row)) << world;
    row.verdict = Verdict::unreachable;
  }
}

TEST(RowText, HasAsManyColumnsAsTheHeader) {
  const std::string header = kRowHeader;
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), std::count(kLine.begin(), kLine.end(), ','));
  EXPECT_EQ(to_csv(parse_row(kLine)), kLine);
}

TEST(RowText, EveryRowReadsBackEqual) {
  worlds::Random random(3);
  for (int i = 0; i < 5000; ++i) {
    const Row row = random_row(random);
    const std::string line = to_csv(row);
    const Row back = parse_row(line);
    ASSERT_EQ(to_csv(back), line);
    ASSERT_EQ(back.seed, row.seed);
    ASSERT_EQ(back.verdict, row.verdict);
    ASSERT_EQ(back.time_s, row.time_s);
    ASSERT_EQ(back.path_m, row.path_m);
    ASSERT_EQ(back.min_clearance_m, row.min_clearance_m);
    ASSERT_EQ(back.estimate_error_m, row.estimate_error_m);
    ASSERT_EQ(back.at_goal, row.at_goal);
    ASSERT_EQ(back.believed_distance_m, row.believed_distance_m);
    ASSERT_EQ(back.shortest_m, row.shortest_m);
    ASSERT_EQ(back.looks, row.looks);
    ASSERT_EQ(back.hash, row.hash);
    ASSERT_EQ(back.detail, row.detail);
    ASSERT_EQ(back.robot, row.robot);
    ASSERT_EQ(back.world, row.world);
  }
}

TEST(RowText, WhatIsWrongIsNamed) {
  EXPECT_EQ(complaint(kLine), "");
  EXPECT_EQ(complaint(""), "column seed: '' is no such number");
  EXPECT_EQ(complaint("7"), "no column outcome");
  EXPECT_EQ(complaint(with("7,", "-7,")), "column seed: '-7' is no such number");
  EXPECT_EQ(complaint(with("reached", "Reached")), "column outcome: 'Reached' is none");
  EXPECT_EQ(complaint(with("12.500000", "nan")), "column time_s: 'nan' is no such number");
  EXPECT_EQ(complaint(with("12.500000", "inf")), "column time_s: 'inf' is no such number");
  EXPECT_EQ(complaint(with("2.000000", "-2.000000")), "column path_m: -2 is negative");
  EXPECT_EQ(complaint(with(",1,2,3,", ",1,2.5,3,")), "column flips: '2.5' is no such number");
  EXPECT_EQ(complaint(kLine + "\r"), "column missions: control characters in it");
  EXPECT_EQ(complaint(kOldLine), "no column believed_distance_m");
  EXPECT_EQ(complaint(kJudgedLine), "no column mission");
  for (const std::string& line :
       {with("1.250000", "1.260000"), with("12.500000", "12.5"), with("discs", "\"discs\""), kLine + ",",
        with("00ff", "00FF"), with(",1,1.6", ",2,1.6"), with(",1,1.6", ",,1.6"), with(",1,1.6", ",0,1.6"),
        with("reached", "off_goal"), with(",0.080000,1", ",0.080000,0"), with(",5,60", ",61,60")}) {
    EXPECT_EQ(complaint(line), "the row is not one that campaign writes") << line;
  }
}

TEST(RowText, AnOldRowTellsWhatItsRobotBelievedAndIsJudgedByItsTruePlace) {
  const Row there = parse_row(kOldLine, RowFormat::believed);
  EXPECT_EQ(there.verdict, Verdict::reached);
  EXPECT_FALSE(there.believed_distance_m);
  std::string line = kOldLine;
  line.replace(line.find(",1,1.6"), 2, ",0");
  const Row off = parse_row(line, RowFormat::believed);
  EXPECT_EQ(off.verdict, Verdict::off_goal);
  EXPECT_TRUE(succeeded(off));
  EXPECT_EQ(to_csv(off).find("7,off_goal,"), 0U) << to_csv(off);
  EXPECT_EQ(to_csv(parse_row(to_csv(off))), to_csv(off));
  for (std::string wrong :
       {with("reached", "off_goal").substr(0, kOldLine.size() + 1), kLine, kOldLine + ","})
    EXPECT_THROW(parse_row(wrong, RowFormat::believed), std::invalid_argument) << wrong;
}

TEST(RowText, ARowWithoutTheNumberOfItsMissionIsRead) {
  const Row row = parse_row(kJudgedLine, RowFormat::judged);
  EXPECT_EQ(row.missions, 0U);
  EXPECT_EQ(to_csv(row), kJudgedLine + ",0,0");
  EXPECT_THROW(parse_row(kLine, RowFormat::judged), std::invalid_argument);
}

TEST(RowText, ADamagedRowIsRefusedOrIsAnotherRow) {
  const std::string alphabet = "0123456789.,-+e\"' nf\n\xFF";
  worlds::Random random(5);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string line = to_csv(random_row(random));
    const auto place = [&] { return static_cast<std::size_t>(random.index(static_cast<int>(line.size()))); };
    const char letter = alphabet[static_cast<std::size_t>(random.index(static_cast<int>(alphabet.size())))];
    switch (random.index(3)) {
      case 0: line[place()] = letter; break;
      case 1: line.insert(place(), 1, letter); break;
      default: line.erase(place(), 1);
    }
    try {
      ASSERT_EQ(to_csv(parse_row(line)), line);
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10000);
}

TEST(RowText, NoPrefixOfARowIsARow) {
  for (std::size_t n = 0; n <= kLine.rfind(',') + 1; ++n) EXPECT_NE(complaint(kLine.substr(0, n)), "") << n;
}

TEST(RowFile, HoldsTheHeaderAndEveryRow) {
  const Folder folder;
  const std::string path = folder.path("rows.csv");
  RowFile file(path);
  file.add(parse_row(kLine));
  EXPECT_EQ(text_of(path), "");
  EXPECT_EQ(text_of(path + ".part"), std::string(kRowHeader) + "\n" + kLine + "\n") << "whole at any time";
  file.finish();
  EXPECT_EQ(text_of(path), std::string(kRowHeader) + "\n" + kLine + "\n");
  EXPECT_EQ(text_of(path + ".part"), "");
}

TEST(RowFile, GoesOnAfterTheRowsOfAnEarlierOne) {
  const Folder folder;
  const std::string path = folder.file("rows.csv", "old\n");
  {
    RowFile file(path);
    EXPECT_TRUE(file.found().empty());
    file.add(parse_row(kLine));
  }
  EXPECT_EQ(text_of(path), "old\n");
  RowFile file(path);
  ASSERT_EQ(file.found().size(), 1U);
  EXPECT_EQ(to_csv(file.found().front()), kLine);
  file.add(parse_row(with("7,", "8,")));
  file.finish();
  EXPECT_EQ(text_of(path), std::string(kRowHeader) + "\n" + kLine + "\n" + with("7,", "8,") + "\n");
}

TEST(RowFile, SaysWhyItCannotBeWritten) {
  const Folder folder;
  for (const std::string& path : {folder.path("no/rows.csv"), folder.path(""), std::string("/dev/full")}) {
    EXPECT_THROW(RowFile file(path), std::runtime_error) << path;
  }
}

constexpr double kTrack = 0.14;

struct Tick {
  double speed = 0, turn_rate = 0;
  bool looked = false;
};

MotionCount counted(const std::vector<Tick>& ticks) {
  MotionCount count(kTrack);
  for (const Tick& tick : ticks) {
    TickRecord r;
    r.v_left_mps = tick.speed - tick.turn_rate * kTrack / 2;
    r.v_right_mps = tick.speed + tick.turn_rate * kTrack / 2;
    r.looked = tick.looked;
    count.add(r);
  }
  return count;
}

std::uint64_t stops(const std::vector<double>& speeds) {
  std::vector<Tick> ticks;
  for (const double speed : speeds) ticks.push_back({speed});
  return counted(ticks).stops();
}

std::uint64_t flips(const std::vector<double>& rates) {
  std::vector<Tick> ticks;
  for (const double rate : rates) ticks.push_back({0.2, rate});
  return counted(ticks).flips();
}

TEST(MotionCount, AStopCountsWhenTheRobotDrivesOn) {
  EXPECT_EQ(stops({}), 0U);
  EXPECT_EQ(stops({0, 0, 0.06, 0.3}), 0U) << "setting out";
  EXPECT_EQ(stops({0, 0.3, 0, 0}), 0U) << "the last one";
  EXPECT_EQ(stops({0.3, 0, 0, 0.3, 0.009, 0.3, 0}), 2U);
  EXPECT_EQ(stops({0.3, -0.2, 0.3}), 1U) << "backing up";
  EXPECT_EQ(stops({0.3, 0.011, 0.3}), 0U) << "only slow";
  EXPECT_EQ(stops({0.3, 0, 0.049, 0, 0.049, 0.3}), 1U) << "creeping is no driving";
}

TEST(MotionCount, AFlipIsATurnToTheOtherSide) {
  EXPECT_EQ(flips({0.5, 1, 0.3, 0.5}), 0U);
  EXPECT_EQ(flips({0.5, -0.5, 0.5}), 2U);
  EXPECT_EQ(flips({0.5, 0, 0, -0.5}), 1U);
  EXPECT_EQ(flips({0.5, -0.19, 0.5}), 0U) << "too slow for a turn";
  EXPECT_EQ(flips({0.5, -0.21, 0.5}), 2U);
}

TEST(MotionCount, ALookIsASpellOfLooking) {
  const auto looks = [](const std::vector<int>& looked) {
    std::vector<Tick> ticks;
    for (const int l : looked) ticks.push_back({0, 0, l != 0});
    return counted(ticks).looks();
  };
  EXPECT_EQ(looks({0, 0}), 0U);
  EXPECT_EQ(looks({1, 0, 1, 0, 0, 1}), 3U);
  EXPECT_EQ(looks({0, 1, 1, 1, 0}), 1U);
}

TEST(MotionCount, TurningSumsUpBothWays) {
  MotionCount count(kTrack);
  for (const double heading : {7.0, 7.5, 7.25, 6.25}) {
    TickRecord r;
    r.heading_rad = heading;
    count.add(r);
  }
  EXPECT_DOUBLE_EQ(count.turned_rad(), 1.75);
}

}  // namespace
}  // namespace whisker::campaign
