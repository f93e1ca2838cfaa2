// A stream replays the run that it records, and the judge of its answers names the first difference in any
// field.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

#include "firmware/apps/golden/player.hpp"
#include "tests/golden/compare.hpp"
#include "tests/golden/stream.hpp"

namespace whisker::golden {
namespace {

class Script final : public hal::ByteStream {
 public:
  explicit Script(const Bytes& input) : input_(input) {}
  bool read(std::uint8_t* to, std::size_t count) noexcept override {
    if (at_ + count > input_.size()) return false;
    std::memcpy(to, input_.data() + at_, count);
    at_ += count;
    return true;
  }
  bool write(const std::uint8_t* from, std::size_t count) noexcept override {
    output.insert(output.end(), from, from + count);
    return true;
  }
  Bytes output;

 private:
  const Bytes& input_;
  std::size_t at_ = 0;
};

Total played(const Stream& stream) {
  std::string index;
  const Bytes bytes = recording({stream}, index);
  Script script(bytes);
  EXPECT_EQ(std::make_unique<Player>(script, hal::board().meter)->run(), 0) << stream.name;
  return decode<Total>(script.output.data() + script.output.size() - size_of<Total>());
}

TEST(Stream, ReplaysTheRunThatItRecords) {
  for (const Stream& stream : drives()) EXPECT_EQ(played(stream).hash, stream.hash) << stream.name;
}

struct Recorded {
  Bytes sent;
  std::string index = "0 walk\n";
  Bytes answers;
};

/// Three ticks and a probe, with invented answers.
Recorded recorded() {
  Recorded r;
  for (int i = 0; i < 3; ++i) append(r.sent, Name::tick, Tick{});
  append(r.sent, Name::fuzzy, Probe{});
  append(r.sent, Name::end);
  for (std::uint32_t work : {10U, 30U, 20U}) {
    Answer a;
    a.work = work;
    append(r.answers, a);
  }
  append(r.answers, Reaction{});
  append(r.answers, Total{3, 99, 500});
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
  Bytes wrong = r.answers;
  const std::size_t second = size_of<Answer>();
  wrong[second + 4] = 7;  // after the two speeds
  EXPECT_EQ(judge(r.sent, r.index, r.answers, wrong).difference, "walk, tick 1: mode is 7, not 0");
}

TEST(Judge, SeesEveryBitButWorkAndStack) {
  const Recorded r = recorded();
  std::size_t ignored = 0;
  for (std::size_t bit = 0; bit < 8 * r.answers.size(); ++bit) {
    Bytes wrong = r.answers;
    wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << bit % 8);
    ignored += judge(r.sent, r.index, r.answers, wrong).difference.empty();
  }
  EXPECT_EQ(ignored, 4U * 32U) << "three ticks' work, one stack";
}

TEST(Judge, MissesNothingThatIsMissing) {
  const Recorded r = recorded();
  for (std::size_t size = 0; size < r.answers.size(); ++size) {
    const Bytes shorter(r.answers.begin(), r.answers.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(judge(r.sent, r.index, r.answers, shorter).difference, "") << size;
  }
}

}  // namespace
}  // namespace whisker::golden
