#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "hal/ports/can_queue.hpp"
#include "hal/ports/slcan/line.hpp"
#include "hal/ports/slcan/slcan.hpp"
#include "tests/bus/frames.hpp"
#include "tests/slcan/pipe.hpp"

namespace whisker::hal::slcan {
namespace {

using bus::frame;
using bus::kLife_ms;
using bus::remote;
using bus::taken;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SlcanAdapter : public ::testing::Test {
 protected:
  SlcanAdapter() { port.poll(now); }
  std::string answer(const std::string& bytes) {
    pipe.come(bytes);
    port.poll(++now);
    return pipe.sent();
  }
  std::uint32_t now = UINT32_MAX - 5;
  Pipe pipe;
  Slcan port{pipe, Role::adapter};
};

TEST_F(SlcanAdapter, IsOpenFromTheStart) {
  EXPECT_EQ(port.state(), CanState::active);
  EXPECT_EQ(answer("t12321122\r"), "z\r");
  EXPECT_EQ(answer("T000001230\r"), "Z\r");
  EXPECT_EQ(answer("r1234\r"), "z\r");
  const CanFrame extended{0x123, true, false, 0, {}};
  EXPECT_THAT(taken(port),
              ElementsAre(CanFrame{0x123, false, false, 2, {0x11, 0x22}}, extended, remote(0x123, 4)));
}

TEST_F(SlcanAdapter, SendsWholeLinesInOrder) {
  ASSERT_TRUE(port.send(frame(0x300, 1), kLife_ms));
  ASSERT_TRUE(port.send(frame(0x100, 0), kLife_ms));
  EXPECT_EQ(answer(""), "t300100\rt1000\r");
  EXPECT_EQ(port.counts().sent, 2U);
}

TEST_F(SlcanAdapter, ObeysOpenAndClose) {
  EXPECT_EQ(answer("O\r"), "\a");
  EXPECT_EQ(answer("S6\r"), "\a");
  EXPECT_EQ(answer("C\r"), "\r");
  EXPECT_EQ(port.state(), CanState::starting);
  EXPECT_EQ(answer("C\r"), "\a");
  EXPECT_EQ(answer("t1230\r"), "\a");
  EXPECT_FALSE(port.send(frame(1), kLife_ms));
  EXPECT_EQ(answer("S6\r"), "\r");
  EXPECT_EQ(answer("O\r"), "\r");
  EXPECT_EQ(port.state(), CanState::active);
  EXPECT_THAT(taken(port), IsEmpty());
  EXPECT_TRUE(port.send(frame(1), kLife_ms));
}

TEST_F(SlcanAdapter, TellsWhatItIs) {
  EXPECT_EQ(answer("V\r"), "V0101\r");
  EXPECT_EQ(answer("N\rF\r"), "NWHSK\rF00\r");
  EXPECT_EQ(answer("Z0\r"), "\r");
  EXPECT_EQ(answer("Z1\r"), "\a");
  EXPECT_EQ(answer("?\r"), "\a");
  EXPECT_EQ(answer("\r\r\n\r"), "");
}

TEST_F(SlcanAdapter, GoesOnAfterGarbage) {
  const std::string garbage = "\x01\xff\a" + std::string(1000, 'q');
  EXPECT_EQ(answer(garbage + "\r"), "");
  EXPECT_EQ(answer(""), "\a");
  EXPECT_EQ(answer("t123"), "");
  EXPECT_EQ(answer("t1230\r"), "\a");
  EXPECT_EQ(answer("t1230\r"), "z\r");
  EXPECT_THAT(taken(port), ElementsAre(frame(0x123, 0)));
  EXPECT_EQ(port.line_counts().bad_lines, 2U);
}

TEST_F(SlcanAdapter, TakesNoFrameFromTheEndOfALineThatIsTooLong) {
  for (std::size_t length = 1; length < 4 * kLongestLine; ++length) {
    EXPECT_EQ(answer(std::string(length, 'q') + "t1230\r"), "\a") << length;
  }
  EXPECT_THAT(taken(port), IsEmpty());
}

RC_GTEST_FIXTURE_PROP(SlcanAdapter, WhateverComesBeforeALineEndIsForgottenAfterIt, (std::string noise)) {
  // Commands change the state, as intended.
  pipe.come(noise + "\r");
  for (int i = 0; i < 20; ++i) port.poll(++now);
  taken(port);
  for (int i = 0; i < 20; ++i) port.poll(++now);
  taken(port);
  answer("C\rO\r");
  RC_ASSERT(answer("t1230\r") == "z\r");
  RC_ASSERT(taken(port) == std::vector{frame(0x123, 0)});
}

TEST_F(SlcanAdapter, LeavesBytesInTheLineWhileNobodyTakesFrames) {
  for (int i = 0; i < 20; ++i) pipe.come("t1000\r");
  for (int i = 0; i < 3; ++i) port.poll(++now);
  EXPECT_EQ(pipe.in.size(), 6U * (20 - CanPort::kReceiveDepth));
  EXPECT_EQ(taken(port).size(), CanPort::kReceiveDepth);
  port.poll(++now);
  EXPECT_EQ(taken(port).size(), 20U - CanPort::kReceiveDepth);
  EXPECT_EQ(port.counts().overrun, 0U);
}

TEST_F(SlcanAdapter, DropsWhatALineThatIsFullLeavesTooOld) {
  pipe.space = 7;
  ASSERT_TRUE(port.send(frame(0x111, 1), kLife_ms));
  ASSERT_TRUE(port.send(frame(0x222, 1), kLife_ms));
  for (int i = 0; i <= kLife_ms; ++i) port.poll(++now);
  EXPECT_EQ(port.counts().sent, 0U);
  EXPECT_EQ(port.counts().expired, 1U);
  pipe.space = SIZE_MAX;
  ASSERT_TRUE(port.send(frame(0x333, 1), kLife_ms));
  port.poll(++now);
  EXPECT_EQ(pipe.sent(), "t111100\rt333100\r") << "a line that has begun is ended";
  EXPECT_EQ(port.counts().sent, 2U);
}

TEST_F(SlcanAdapter, NeverPutsAnAnswerIntoALine) {
  pipe.space = 3;
  ASSERT_TRUE(port.send(frame(0x111, 1), kLife_ms));
  port.poll(++now);
  pipe.come("V\rt1000\r");
  port.poll(++now);
  pipe.space = SIZE_MAX;
  port.poll(++now);
  EXPECT_EQ(pipe.sent(), "t111100\rV0101\rz\r");
}

TEST_F(SlcanAdapter, ForgetsAnswersForWhichThereIsNoRoom) {
  pipe.space = 0;
  for (int i = 0; i < 10; ++i) answer("V\r");
  pipe.space = SIZE_MAX;
  EXPECT_EQ(answer(""), "V0101\rV0101\rV0101\rV0101\rV0101\rV0101\r");
  EXPECT_EQ(port.line_counts().lost_answers, 4U);
}

TEST_F(SlcanAdapter, StartsAnewWithTheLine) {
  pipe.space = 3;
  ASSERT_TRUE(port.send(frame(0x111, 1), kLife_ms));
  ASSERT_TRUE(port.send(frame(0x222, 1), kLife_ms));
  answer("t12");
  pipe.up = false;
  port.poll(++now);
  EXPECT_EQ(port.state(), CanState::starting);
  EXPECT_EQ(port.counts().expired, 2U);
  EXPECT_FALSE(port.send(frame(1), kLife_ms));
  pipe.up = true;
  pipe.space = SIZE_MAX;
  EXPECT_EQ(answer("t1230\r"), "z\r");
  EXPECT_EQ(port.state(), CanState::active);
  EXPECT_THAT(taken(port), ElementsAre(frame(0x123, 0)));
}

std::string text_of(const CanFrame& f) {
  std::uint8_t line[kLongestLine];
  return {reinterpret_cast<char*>(line), write_line(f, line)};
}

bool read(const std::string& text, CanFrame& out) {
  return read_line(reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::uint8_t>(text.size()),
                   out);
}

TEST(SlcanLine, IsTheManuals) {
  EXPECT_EQ(text_of({0x100, false, false, 1, {0x2F}}), "t10012F");
  EXPECT_EQ(text_of({0x7FF, false, false, 0, {}}), "t7FF0");
  EXPECT_EQ(text_of({0x100, true, false, 2, {0x11, 0xAB}}), "T00000100211AB");
  EXPECT_EQ(text_of(remote(0x5, 3)), "r0053");
  EXPECT_EQ(text_of(remote(0x1FFFFFFF, 8)), "R1FFFFFFF8");
  EXPECT_EQ(text_of(frame(0x1FFFFFFF)).size(), kLongestLine - kTimeStamp);
}

TEST(SlcanLine, IsReadInEitherCase) {
  CanFrame f{};
  ASSERT_TRUE(read("t1ab2cDeF", f));
  EXPECT_EQ(f, (CanFrame{0x1AB, false, false, 2, {0xCD, 0xEF}}));
}

TEST(SlcanLine, IsRefusedUnlessItIsWhole) {
  for (const char* bad : {"",
                          "t",
                          "t12",
                          "t123",
                          "t1239",
                          "t123900112233445566778899",
                          "t12320011223",
                          "t1232001",
                          "t123200112",
                          "t12g0",
                          "t1230 ",
                          "t 123",
                          "tFFF0",
                          "t8000",
                          "T12345678",
                          "TFFFFFFFF0",
                          "T200000000",
                          "T1FFFFFF",
                          "r12340",
                          "r123411223344",
                          "R1234567",
                          "x1230",
                          "t1232GG00",
                          "t12-0",
                          "O",
                          "V0101",
                          "z"}) {
    CanFrame f = frame(0x55);
    EXPECT_FALSE(read(bad, f)) << bad;
    EXPECT_EQ(f, frame(0x55)) << bad;
  }
}

CanFrame any_frame() {
  CanFrame f{};
  f.extended = *rc::gen::arbitrary<bool>();
  f.remote = *rc::gen::arbitrary<bool>();
  f.id = *rc::gen::inRange(0U, f.extended ? 0x20000000U : 0x800U);
  f.size = *rc::gen::inRange<std::uint8_t>(0, 9);
  for (std::uint8_t& byte : f.data) byte = *rc::gen::arbitrary<std::uint8_t>();
  return f;
}

RC_GTEST_PROP(SlcanLine, ComesBackAsItWas, ()) {
  const CanFrame f = any_frame();
  CanFrame back{};
  RC_ASSERT(read(text_of(f), back));
  RC_ASSERT(back == f);
}

RC_GTEST_PROP(SlcanLine, ThatIsCutOrGrownOrMutilatedNeverHasABadShape, ()) {
  std::string text = text_of(any_frame());
  const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
  switch (*rc::gen::inRange(0, 3)) {
    case 0: text.erase(at, 1); break;
    case 1: text.insert(at, 1, *rc::gen::arbitrary<char>()); break;
    default: text[at] = *rc::gen::arbitrary<char>();
  }
  CanFrame back{};
  if (read(text, back)) {
    RC_ASSERT(well_formed(back));
    std::string upper = text_of(back);
    for (char& c : text)
      c = &c == text.data() ? c : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    RC_ASSERT(upper == text);
  }
}

}  // namespace
}  // namespace whisker::hal::slcan
