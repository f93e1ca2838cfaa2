#include "host/campaign/ordered.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

#include "host/worlds/random.hpp"

namespace whisker::campaign {
namespace {

/// Work whose pieces take unequal time; each returns its own number as the seed.
Work uneven(std::uint64_t count, int jobs, std::vector<std::uint64_t>& taken) {
  Work work;
  work.count = count;
  work.jobs = jobs;
  work.make = [](std::uint64_t piece, const std::atomic<bool>&) {
    std::this_thread::sleep_for(std::chrono::microseconds(worlds::Random(piece).index(400)));
    Row row;
    row.seed = piece;
    return row;
  };
  work.take = [&taken](const Row& row) { taken.push_back(row.seed); };
  work.wait = [](std::uint64_t) {};
  work.stop = [] { return false; };
  return work;
}

void expect_first(const std::vector<std::uint64_t>& taken) {
  for (std::size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
}

TEST(Ordered, ResultsComeInOrderWhateverTheNumberOfThreads) {
  for (const int jobs : {1, 2, 3, 16, 200}) {
    std::vector<std::uint64_t> taken;
    EXPECT_EQ(do_in_order(uneven(150, jobs, taken)), 150U);
    EXPECT_EQ(taken.size(), 150U);
    expect_first(taken);
  }
}

TEST(Ordered, NothingToDoIsDone) {
  std::vector<std::uint64_t> taken;
  EXPECT_EQ(do_in_order(uneven(0, 4, taken)), 0U);
}

TEST(Ordered, AStopLeavesTheFirstResultsOnly) {
  for (const int jobs : {1, 4}) {
    std::vector<std::uint64_t> taken;
    Work work = uneven(100000, jobs, taken);
    work.stop = [&] { return taken.size() >= 20; };
    const std::uint64_t done = do_in_order(work);
    EXPECT_EQ(done, taken.size());
    EXPECT_GE(done, 20U);
    EXPECT_LT(done, 100000U);
    expect_first(taken);
  }
}

TEST(Ordered, PiecesUnderWayAreToldToStop) {
  std::vector<std::uint64_t> taken;
  Work work = uneven(100, 3, taken);
  const auto quick = work.make;
  work.make = [&](std::uint64_t piece, const std::atomic<bool>& stop) {
    while (piece >= 5 && !stop) std::this_thread::yield();
    if (piece >= 5) throw Stopped{};
    return quick(piece, stop);
  };
  work.stop = [&] { return taken.size() == 5; };
  EXPECT_EQ(do_in_order(work), 5U);
  expect_first(taken);
}

TEST(Ordered, AnErrorComesAfterTheResultsBeforeIt) {
  for (const int jobs : {1, 2, 8}) {
    std::vector<std::uint64_t> taken;
    Work work = uneven(1000, jobs, taken);
    const auto good = work.make;
    work.make = [&](std::uint64_t piece, const std::atomic<bool>& stop) {
      if (piece == 37) throw std::runtime_error("37");
      return good(piece, stop);
    };
    EXPECT_THROW(do_in_order(work), std::runtime_error);
    EXPECT_EQ(taken.size(), 37U);
    expect_first(taken);
  }
}

TEST(Ordered, AnErrorOfTheTakerEndsTheWork) {
  std::vector<std::uint64_t> taken;
  Work work = uneven(1000, 4, taken);
  work.take = [](const Row&) { throw std::runtime_error("full"); };
  EXPECT_THROW(do_in_order(work), std::runtime_error);
}

}  // namespace
}  // namespace whisker::campaign
