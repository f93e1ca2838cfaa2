#include "host/harness/hil/resend.hpp"

#include <rapidcheck/gtest.h>

namespace whisker::hil {
namespace {

constexpr std::uint64_t kLeast_us = 20000;

/// A set that is answered after this time, whichever copy it answers. Returns the number of repeats.
int exchange(Resend& resend, std::uint64_t& now_us, std::uint64_t answer_us) {
  int again = 0;
  resend.sent(now_us);
  for (std::uint64_t passed_us = 0; passed_us < answer_us; passed_us += 1000, now_us += 1000) {
    if (!resend.due(now_us)) continue;
    resend.sent_again(now_us);
    ++again;
  }
  resend.answered(now_us);
  return again;
}

RC_GTEST_PROP(Resend, LearnsHowLongAnswersTake, ()) {
  Resend resend(kLeast_us);
  std::uint64_t now_us = 0;
  const std::uint64_t answer_us = *rc::gen::inRange<std::uint64_t>(1, 200) * 1000;
  int again = 0;
  for (int i = 0; i < 100; ++i) again += exchange(resend, now_us, answer_us);
  RC_ASSERT(again <= 8);
  RC_ASSERT(resend.wait_us() == std::max(Resend::kSpare * answer_us, kLeast_us));
}

RC_GTEST_PROP(Resend, WaitsNeverLessThanTheLeastNorMoreThanTheMost, ()) {
  Resend resend(kLeast_us);
  std::uint64_t now_us = 0;
  for (const int answer_ms : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 5000))) {
    exchange(resend, now_us, static_cast<std::uint64_t>(answer_ms) * 1000);
    RC_ASSERT(resend.wait_us() >= kLeast_us);
    RC_ASSERT(resend.wait_us() <= Resend::kMost_us);
  }
}

TEST(Resend, DoublesWhileNobodyAnswers) {
  Resend resend(kLeast_us);
  std::uint64_t now_us = 0;
  // Repeats at 20, 60, 140, 300, 620, 1260, 1900 ms.
  EXPECT_EQ(exchange(resend, now_us, 2000000), 7);
  EXPECT_EQ(resend.wait_us(), Resend::kMost_us);
}

TEST(Resend, IsQuickAgainAfterALoss) {
  Resend resend(kLeast_us);
  std::uint64_t now_us = 0;
  exchange(resend, now_us, 1000);
  EXPECT_EQ(exchange(resend, now_us, 25000), 1);
  EXPECT_EQ(resend.wait_us(), 2 * kLeast_us);
  exchange(resend, now_us, 1000);
  EXPECT_EQ(resend.wait_us(), kLeast_us);
}

}  // namespace
}  // namespace whisker::hil
