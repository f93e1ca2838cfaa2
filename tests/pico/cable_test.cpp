#include "host/harness/pico/cable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "firmware/can/headers.hpp"
#include "firmware/params/words.hpp"
#include "hal/ports/slcan/line.hpp"
#include "host/harness/hil/overheard.hpp"

namespace whisker::pico {
namespace {

constexpr std::uint8_t kController = 1, kBase = kController + can::kBaseOffset;
constexpr int kLongest_ms = 60000;

/// A robot that is ready, and knows the first parameters only, or gives no answer at all.
class Stub {
 public:
  explicit Stub(int params) : params_(params) {}

  /// A millisecond.
  std::string say(int ms, const std::string& heard) {
    said_.clear();
    if (ms % 100 == 0) {
      send(can::Heartbeat{can::NodeState::running}, kController);
      send(can::Heartbeat{can::NodeState::running}, kBase);
    }
    for (const char c : heard) {
      if (c == '\r') {
        hear();
        line_.clear();
      } else {
        line_.push_back(c);
      }
    }
    return said_;
  }

 private:
  void hear() {
    hal::CanFrame frame;
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(line_.data());
    if (!hal::slcan::read_line(bytes, static_cast<std::uint8_t>(line_.size()), frame)) return;
    can::MessageKind kind = can::MessageKind::e_stop;
    if (!can::kind_of(frame.id, kind) || kind != can::MessageKind::param_request) return;
    hil::with<can::ParamRequest>(frame, [this](const can::ParamRequest& asked) {
      if (params_ < 0) return;
      const bool known = asked.index < params_ || asked.index == can::kCommitIndex;
      send(can::ParamReply{known ? can::ParamStatus::ok : can::ParamStatus::no_such, asked.index, asked.value,
                           1},
           kController);
    });
  }
  template <class M>
  void send(const M& message, std::uint8_t node) {
    std::uint8_t line[hal::slcan::kLongestLine];
    const std::uint8_t size = hal::slcan::write_line(can::encode(message, node, alive_[node].next()), line);
    said_.append(reinterpret_cast<const char*>(line), size);
    said_.push_back('\r');
  }

  const int params_;
  std::string line_;
  std::string said_;
  can::AliveSender alive_[2 * can::kBaseOffset];
};

/// What the cable says of this robot.
std::string trouble_of(int params) {
  Cable cable(Params{}, kDefaultPlanner, {});
  Stub robot(params);
  std::string heard;
  for (int ms = 1; ms < kLongest_ms && cable.trouble().empty(); ++ms)
    heard = cable.step(static_cast<std::uint64_t>(ms) * 1000, robot.say(ms, heard));
  EXPECT_FALSE(cable.ordered());
  return cable.trouble();
}

TEST(Cable, AnImageWithFewerParametersEndsTheTalk) {
  EXPECT_THAT(trouble_of(40), testing::MatchesRegex("parameter 4[0-9]: no_such"));
}

TEST(Cable, SilenceEndsTheTalk) { EXPECT_EQ(trouble_of(-1), "parameter 0: no answer"); }

TEST(Cable, ARobotThatTakesNoGoalEndsTheTalk) { EXPECT_EQ(trouble_of(kParams), "the goal: no answer"); }

}  // namespace
}  // namespace whisker::pico
