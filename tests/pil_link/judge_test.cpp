// The judge of golden answers names the first difference in any field.
#include <gtest/gtest.h>

#include <string>

#include "firmware/apps/pil_link/session.hpp"
#include "tests/golden/compare.hpp"

namespace whisker::golden {
namespace {

struct Recorded {
  chip::Bytes sent;
  std::string index = "1 walk\n";
  chip::Bytes answers;
};

/// Three ticks and a probe, with invented answers.
Recorded recorded() {
  Recorded r;
  chip::append(r.sent, link::Name::hello);
  for (int i = 0; i < 3; ++i) chip::append(r.sent, link::Name::tick, link::Tick{});
  chip::append(r.sent, link::Name::fuzzy, link::Probe{});
  chip::append(r.sent, link::Name::end);
  const auto answer = [&](const auto& message) {
    using M = std::decay_t<decltype(message)>;
    r.answers.resize(r.answers.size() + link::size_of<M>());
    link::encode(message, r.answers.data() + r.answers.size() - link::size_of<M>());
  };
  answer(link::Greeting{});
  for (std::uint32_t work : {10U, 30U, 20U}) {
    link::Answer a;
    a.work = work;
    answer(a);
  }
  answer(link::Reaction{});
  answer(link::Total{3, 99, 500});
  return r;
}

TEST(Judge, CountsCostsAndAcceptsEqualAnswers) {
  const Recorded r = recorded();
  const Judgement j = judge(r.sent, r.index, r.answers, r.answers);
  EXPECT_EQ(j.difference, "");
  EXPECT_EQ(j.total.hash, 99U);
  ASSERT_EQ(j.costs.size(), 1U);
  EXPECT_EQ(j.costs[0].name, "walk");
  EXPECT_EQ(j.costs[0].ticks, 3U);
  EXPECT_EQ(j.costs[0].work, 60U);
  EXPECT_EQ(j.costs[0].worst, 30U);
}

TEST(Judge, NamesStreamTickAndField) {
  const Recorded r = recorded();
  chip::Bytes wrong = r.answers;
  const std::size_t second = link::size_of<link::Greeting>() + link::size_of<link::Answer>();
  wrong[second + 4] = 7;  // after the two speeds
  EXPECT_EQ(judge(r.sent, r.index, r.answers, wrong).difference, "walk, tick 1: mode is 7, not 0");
}

TEST(Judge, SeesEveryBitButWorkStackAndRoom) {
  const Recorded r = recorded();
  std::size_t ignored = 0;
  for (std::size_t bit = 0; bit < 8 * r.answers.size(); ++bit) {
    chip::Bytes wrong = r.answers;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << bit % 8);
    ignored += judge(r.sent, r.index, r.answers, wrong).difference.empty();
  }
  EXPECT_EQ(ignored, 4U * 32U + 16U) << "three ticks' work, one stack, one room for maps";
}

TEST(Judge, MissesNothingThatIsMissing) {
  const Recorded r = recorded();
  for (std::size_t size = 0; size < r.answers.size(); ++size) {
    const chip::Bytes shorter(r.answers.begin(), r.answers.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(judge(r.sent, r.index, r.answers, shorter).difference, "") << size;
  }
}

}  // namespace
}  // namespace whisker::golden
