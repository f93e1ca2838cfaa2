#include <set>
#include <string>

#include <gtest/gtest.h>

#include "firmware/can/e2e.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/table_hash.hpp"

namespace whisker::can {
namespace {

TEST(Table, TheCrcIsThatOfTheProfile) {
  // AUTOSAR's examples: 8 bytes of zero, data id 0x123, with counters 0 and 1.
  const std::uint8_t zero[8] = {};
  const std::uint8_t one[8] = {0, 1};
  EXPECT_EQ(crc_of(0x123, zero, 8), 0xCC);
  EXPECT_EQ(crc_of(0x123, one, 8), 0x91);
}

TEST(Table, EveryIdentifierIsOneSendersOwn) {
  std::set<std::uint32_t> seen;
  for (const Message& m : kMessages) {
    EXPECT_TRUE(m.from_controller || m.from_base || m.from_operator) << m.name;
    EXPECT_FALSE(m.from_controller && m.from_operator) << m.name << ": they have one number";
    for (std::uint8_t robot = 1; robot <= kRobots; ++robot) {
      for (const Party party : {Party::controller, Party::base}) {
        const std::uint32_t id = id_of(m.function, node_of(robot, party));
        EXPECT_LE(id, 0x7FFU);
        EXPECT_TRUE(seen.insert(id).second) << m.name;
      }
    }
  }
}

TEST(Table, KindsAreItsRows) {
  for (int i = 0; i < kKinds; ++i) {
    MessageKind kind = MessageKind::e_stop;
    ASSERT_TRUE(kind_of(id_of(kMessages[i].function, 9), kind));
    EXPECT_EQ(static_cast<int>(kind), i);
    EXPECT_EQ(head_of(kind).size, kMessages[i].size);
  }
  EXPECT_STREQ(message_of(MessageKind::diagnostics).name, "Diagnostics");
  EXPECT_STREQ(message_of(MessageKind::nav_status).name, "NavStatus");
  MessageKind kind = MessageKind::e_stop;
  EXPECT_FALSE(kind_of(id_of(0x02, 1), kind));
  EXPECT_FALSE(kind_of(0x7FF, kind));
}

TEST(Table, SignalsOfOnePartNeverOverlapAndFitTheFrame) {
  for (const Message& m : kMessages) {
    std::set<std::string> names{"Crc", "Counter"};
    for (int part = 0; part < 16; ++part) {
      std::uint64_t used = 0xFFF;  // CRC and counter
      for (int i = 0; i < m.count; ++i) {
        const Signal& s = m.signals[i];
        EXPECT_EQ(names.insert(s.name).second, part == 0) << m.name << "." << s.name;
        if (s.part >= 0 && s.part != part) continue;
        ASSERT_TRUE(s.length >= 1 && s.length <= 32 && s.start + s.length <= 8 * m.size)
            << m.name << "." << s.name;
        const std::uint64_t bits = ((UINT64_C(1) << s.length) - 1) << s.start;
        EXPECT_EQ(used & bits, 0U) << m.name << "." << s.name;
        used |= bits;
      }
    }
  }
}

TEST(Table, RangesFitTheirSignals) {
  for (const Message& m : kMessages) {
    for (int i = 0; i < m.count; ++i) {
      const Signal& s = m.signals[i];
      const std::int64_t most = (INT64_C(1) << (s.is_signed ? s.length - 1 : s.length)) - 1;
      EXPECT_LE(s.min, s.max) << m.name << "." << s.name;
      EXPECT_LE(s.max, most) << m.name << "." << s.name;
      EXPECT_GE(s.min, s.is_signed ? -most - 1 : 0) << m.name << "." << s.name;
    }
  }
}

TEST(Table, ValuesWithNamesHaveOneEach) {
  for (const Message& m : kMessages) {
    for (int i = 0; i < m.count; ++i) {
      const Signal& s = m.signals[i];
      if (s.word == nullptr) continue;
      std::set<std::string> seen;
      for (std::int64_t raw = s.min; raw <= s.max; ++raw) {
        const char* const word = s.word(raw);
        EXPECT_TRUE(word == nullptr || seen.insert(word).second) << m.name << "." << s.name;
      }
      EXPECT_GE(seen.size(), 2U) << m.name << "." << s.name;
      EXPECT_EQ(s.word(s.max + 1), nullptr) << m.name << "." << s.name;
      EXPECT_EQ(s.word(-1), nullptr) << m.name << "." << s.name;
    }
  }
}

}  // namespace
}  // namespace whisker::can
