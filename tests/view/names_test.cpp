#include "host/view/names.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

namespace whisker::view {
namespace {

TEST(Names, OfThisComputerAlone) {
  for (const char* address : {"127.0.0.1", "localhost", "::1"}) {
    const Names names(address, 8765);
    for (const char* host : {"localhost:8765", "127.0.0.1:8765", "[::1]:8765", "LOCALHOST:8765"}) {
      EXPECT_TRUE(names.knows(host)) << address << " " << host;
    }
    for (const char* host :
         {"", ":", ":8765", "localhost", "localhost:", "localhost:8766", "[::1]", "::1:8765",
          "192.168.1.7:8765", "robot:8765", "localhost.evil.example:8765", "[::1]:8765:8765"}) {
      EXPECT_FALSE(names.knows(host)) << address << " " << host;
    }
  }
  EXPECT_TRUE(Names("127.0.0.5", 1).knows("127.0.0.5:1"));
}

TEST(Names, PortEightyNeedNotBeNamed) { EXPECT_TRUE(Names("127.0.0.1", 80).knows("localhost")); }

TEST(Names, WhereOthersReachItNumbersAreGoodAndForeignNamesAreNot) {
  const Names names("0.0.0.0", 8765);
  char own[256] = {};
  gethostname(own, sizeof own - 1);
  for (const std::string& host : {std::string("192.168.1.7"), std::string("[fe80::1]"),
                                  std::string("localhost"), std::string(own), std::string(own) + ".local"}) {
    EXPECT_TRUE(names.knows(host + ":8765")) << host;
    EXPECT_FALSE(names.knows(host + ":8766")) << host;
  }
  for (const char* host :
       {"evil.example:8765", "192.168.1.7.evil.example:8765", "[evil]:8765", "1.2.3:8765"}) {
    EXPECT_FALSE(names.knows(host)) << host;
  }
  EXPECT_TRUE(Names("robot.lan", 8765).knows("robot.lan:8765"));
  EXPECT_FALSE(Names("robot.lan", 8765).knows("other.lan:8765"));
}

TEST(Names, TheAddressOfThePage) {
  EXPECT_EQ(Names("127.0.0.1", 8765).url(), "http://127.0.0.1:8765/");
  EXPECT_EQ(Names("::1", 8765).url(), "http://[::1]:8765/");
}

}  // namespace
}  // namespace whisker::view
