#include "host/harness/hil/candump.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
                           "(1.000000) can0 123##0112",
                           "(1.000000) can0 FFF#",
                           "(1.000000) can0 20000080#0000000000000000",
                           "(1.000000) can0 123#R9",
                           "(a.b) can0 123#",
                           "(1.0000000) can0 123#",
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
