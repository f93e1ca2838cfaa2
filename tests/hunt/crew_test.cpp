#include "host/hunt/crew.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <set>
#include <stdexcept>

namespace whisker::hunt {
namespace {

TEST(Crew, BringsWhatAJobSaid) {
  const std::string much(1 << 20, 'x');
  const Ended ended = isolated([&](const Say& say) {
    say("a\n");
    say(much);
  });
  EXPECT_EQ(ended.text, "a\n" + much);
  EXPECT_EQ(ended.death, "");
}

TEST(Crew, ADeathIsAResult) {
  const Ended killed = isolated([](const Say& say) {
    say("before");
    ::raise(SIGFPE);
  });
  EXPECT_EQ(killed.text, "before");
  EXPECT_EQ(killed.death, "signal 8");
  const Ended threw = isolated([](const Say& say) {
    say("before");
    throw std::runtime_error("why");
  });
  EXPECT_EQ(threw.text, "before");
  EXPECT_EQ(threw.death, "why");
}

TEST(Crew, RunsSeveralAtOnce) {
  Crew crew;
  for (std::uint64_t id = 1; id <= 5; ++id) {
    crew.start(id, [id](const Say& say) { say(std::to_string(id)); });
  }
  std::set<std::string> all;
  while (crew.busy() > 0) {
    for (const Ended& ended : crew.wait()) {
      EXPECT_EQ(ended.text, std::to_string(ended.id));
      all.insert(ended.text);
    }
  }
  EXPECT_EQ(all.size(), 5U);
}

}  // namespace
}  // namespace whisker::hunt
