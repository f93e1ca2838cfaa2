#include "host/harness/hil/candump.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>
#include <utility>

namespace whisker::hil {
namespace {

TEST(Candump, ReadsWhatCandumpWrites) {
  const auto entry = parse_log_line("(1436509052.249713) vcan0 044#2A366C2BBA");
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->time_us, 1436509052249713U);
  EXPECT_EQ(entry->interface, "vcan0");
  EXPECT_EQ(entry->frame.id, 0x44U);
  EXPECT_EQ(entry->frame.size, 5);
  EXPECT_EQ(entry->frame.data[4], 0xBA);
  EXPECT_FALSE(entry->frame.extended);
  EXPECT_TRUE(parse_log_line("(1.000000) can0 123#R")->frame.remote);
  EXPECT_EQ(parse_log_line("(1.000000) can0 123#R8")->frame.size, 8);
  EXPECT_TRUE(parse_log_line("(1.000000) can0 00000123#")->frame.extended);
  EXPECT_EQ(parse_log_line("(1.000000) can0 123# R\r")->frame.size, 0);
}

TEST(Candump, ReadsItsOtherFormatsAndThoseOfPythonCan) {
  const LogFrame plain = *parse_log_line("(1.5) can0 123#1122");
  EXPECT_EQ(plain.time_us, 1500000U);
  for (const char* line :
       {"(1.500000)  can0 123#1122", "(1.500000000) can0 123#1122 R", "(1.500000) can0 123#1122 T\r",
        " (1.500000)  can0  123   [2]  11 22", " (1.500000)  can0  RX - -  123   [2]  11 22   '.\"'",
        " (1.500000)  can0  TX B -  123   [2]  11 22"}) {
    const auto entry = parse_log_line(line);
    ASSERT_TRUE(entry) << line;
    EXPECT_EQ(log_line(*entry), log_line(plain)) << line;
    EXPECT_EQ(entry->foreign, nullptr) << line;
  }
  EXPECT_EQ(parse_log_line("  can0  123   [0]")->frame.size, 0);
  const auto code = log_line(*parse_log_line("(0.000000) can0 123#1122334455667788_B"));
  EXPECT_EQ(code, log_line(*parse_log_line("  can0  123   {B}  11 22 33 44 55 66 77 88")));
}

TEST(Candump, NamesFramesThatARobotsBusCannotHave) {
  const std::pair<const char*, const char*> lines[] = {
      {"(1.000000) can0 20000080#0000000000000000", "error"},
      {"  can0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME", "error"},
      {"(1.000000) can0 123##0112233445566778899", "CAN FD"},
      {"(1.000000) can0 00000123##1", "CAN FD"},
      {"  can0  123  [12]  00 01 02 03 04 05 06 07 08 09 0A 0B", "CAN FD"},
      {"(1.000000) can0 123#R", "remote"},
      {"(1.000000) can0 123#R8_9", "remote"},
      {"  can0  123   [4]  remote request", "remote"},
      {"(1.000000) can0 00000123#11", "29-bit"},
  };
  for (const auto& [line, kind] : lines) {
    const auto entry = parse_log_line(line);
    ASSERT_TRUE(entry) << line;
    EXPECT_STREQ(entry->foreign, kind) << line;
  }
}

TEST(Candump, ReaderCountsWhatItSkips) {
  std::istringstream in(
      "\xEF\xBB\xBF(1.000000) can0 20000080#0000000000000000\r\n\tbus-error{}\n\n(1.000000) can0 123#R\n"
      "(2.000000) can0 123#11\n(3.000000) can0 123##0\n(4.000000) can0 123#R\n(5.0");
  LogReader reader(in, "x.log");
  LogFrame frame;
  ASSERT_TRUE(reader.next(frame));
  EXPECT_EQ(reader.line(), 5U);
  EXPECT_EQ(frame.time_us, 2000000U);
  EXPECT_FALSE(reader.next(frame));
  EXPECT_EQ(reader.cut(), 8U);
  EXPECT_EQ(reader.skipped(),
            (std::map<std::string, std::uint64_t>{{"CAN FD", 1}, {"error", 1}, {"remote", 2}}));
}

TEST(Candump, RefusesAllElse) {
  for (const char* line : {"",
                           "x",
                           "(",
                           "(1.0",
                           "(1.000000)",
                           "(1.000000) can0",
                           "(1.000000) can0 ",
                           "(1.000000) can0 12#",
                           "(1.000000) can0 1234#",
                           "(1.000000) can0 123#1",
                           "(1.000000) can0 123#11223344556677889900",
                           "(1.000000) can0 123#GG",
                           "(1.000000) can0 FFF#",
                           "(1.000000) can0 123#R9",
                           "(a.b) can0 123#",
                           "(1.0000000000) can0 123#",
                           "(1.000000) can0 123 [2] 11",
                           "can0 123 [2 11 22",
                           "can0 123 [] ",
                           "can0 1234 [1] 11",
                           "(1.000000)can0 123#",
                           "(1.000000)  123#"}) {
    EXPECT_FALSE(parse_log_line(line)) << line;
  }
}

RC_GTEST_PROP(Candump, EveryFrameComesBack,
              (bool extended, bool remote, std::uint32_t id, std::vector<std::uint8_t> data)) {
  LogFrame in;
  in.time_us = 1234567890123456;
  in.interface = "slcan0";
  in.frame.extended = extended;
  in.frame.remote = remote;
  in.frame.id = id & (extended ? 0x1FFFFFFFU : 0x7FFU);
  in.frame.size = static_cast<std::uint8_t>(data.size() % 9);
  for (std::size_t i = 0; !remote && i < in.frame.size; ++i) in.frame.data[i] = data[i];
  const auto out = parse_log_line(log_line(in));
  RC_ASSERT(out.has_value());
  RC_ASSERT(out->time_us == in.time_us && out->interface == in.interface);
  RC_ASSERT(out->frame.id == in.frame.id && out->frame.extended == extended && out->frame.remote == remote);
  RC_ASSERT(out->frame.size == in.frame.size);
  RC_ASSERT(std::equal(out->frame.data, out->frame.data + 8, in.frame.data));
}

}  // namespace
}  // namespace whisker::hil
