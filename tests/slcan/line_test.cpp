#include "hal/ports/slcan/line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "hal/ports/can_queue.hpp"
#include "tests/bus/frames.hpp"

namespace whisker::hal::slcan {
namespace {

using bus::frame;
using bus::remote;

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
  EXPECT_EQ(text_of(frame(0x1FFFFFFF)).size(), kLongestLine);
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
