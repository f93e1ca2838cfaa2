// Encoding and decoding of the link's messages, and a session that rejects invalid ones.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "firmware/apps/pil_link/session.hpp"
#include "host/chip/messages.hpp"

namespace whisker::link {
namespace {

/// A stream with given input and recorded output.
class Script final : public hal::ByteStream {
 public:
  explicit Script(chip::Bytes input) : input_(std::move(input)) {}
  bool read(uint8_t* to, size_t count) noexcept override {
    if (at_ + count > input_.size()) return false;
    std::memcpy(to, input_.data() + at_, count);
    at_ += count;
    return true;
  }
  bool write(const uint8_t* from, size_t count) noexcept override {
    output.insert(output.end(), from, from + count);
    return true;
  }
  chip::Bytes output;

 private:
  chip::Bytes input_;
  std::size_t at_ = 0;
};

class NoMeter final : public hal::Meter {
 public:
  uint32_t stamp() noexcept override { return 0; }
  uint32_t between(uint32_t, uint32_t) noexcept override { return 0; }
  uint32_t deepest_stack() noexcept override { return 77; }
};

struct Outcome {
  int status;
  chip::Bytes output;
};

Outcome outcome(const chip::Bytes& input) {
  Script script(input);
  NoMeter meter;
  Session session;
  const int status = session.run(script, meter);
  return {status, script.output};
}

chip::Bytes sent(std::initializer_list<Name> names) {
  chip::Bytes bytes;
  for (const Name name : names) chip::append(bytes, name);
  return bytes;
}

TEST(Message, BytesAreLittleEndianInTheOrderOfTheFields) {
  std::uint8_t bytes[size_of<Stand>()];
  encode(Stand{1, -2, 0x89ABCDEF}, bytes);
  const std::uint8_t want[] = {1, 0, 0, 0, 0xFE, 0xFF, 0xFF, 0xFF, 0xEF, 0xCD, 0xAB, 0x89};
  ASSERT_EQ(sizeof bytes, sizeof want);
  EXPECT_EQ(std::memcmp(bytes, want, sizeof want), 0);
}

TEST(Message, EveryBitOfATickComesBack) {
  std::vector<std::uint8_t> bytes(size_of<Tick>());
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
    bytes[i / 8] = static_cast<std::uint8_t>(1U << i % 8);
    std::vector<std::uint8_t> again(bytes.size());
    encode(decode<Tick>(bytes.data()), again.data());
    EXPECT_EQ(again, bytes) << i;
  }
}

TEST(Message, EveryParameterComesBack) {
  Params params;
  params.conditioning.consensus = Consensus::median;
  params.body.radius = Length::from_raw(123457);
  params.thesis.delta = 7_deg;
  params.safety.max_refusals = 9;
  chip::Bytes bytes;
  chip::append_params(bytes, params);
  ASSERT_EQ(bytes.size(), 1 + kParamsSize);
  Params back;
  decode_params(back, bytes.data() + 1);
  chip::Bytes again;
  chip::append_params(again, back);
  EXPECT_EQ(again, bytes);
  EXPECT_EQ(back.conditioning.consensus, Consensus::median);
  EXPECT_EQ(back.body.radius, params.body.radius);
}

TEST(Session, EndsWhenToldAndReportsTheStack) {
  const Outcome o = outcome(sent({Name::hello, Name::end}));
  EXPECT_EQ(o.status, 0);
  ASSERT_EQ(o.output.size(), size_of<Greeting>() + size_of<Total>());
  EXPECT_EQ(decode<Greeting>(o.output.data()).version, kVersion);
  const auto total = decode<Total>(o.output.data() + size_of<Greeting>());
  EXPECT_EQ(total.ticks, 0U);
  EXPECT_EQ(total.stack, 77U);
  EXPECT_EQ(total.hash, CommandHash{}.value());
}

TEST(Session, EndsWithAnErrorOnEverythingElse) {
  EXPECT_EQ(outcome({}).status, 1);
  EXPECT_EQ(outcome(sent({Name::hello})).status, 1) << "the stream ends";
  for (int byte = 0; byte < 256; ++byte) {
    chip::Bytes one{static_cast<std::uint8_t>(byte)};
    one.resize(400);
    one.push_back(static_cast<std::uint8_t>(Name::end));
    if (std::strchr("HPBEF", byte) == nullptr || byte == 0) {
      EXPECT_EQ(outcome(one).status, 1) << "before a beginning: " << byte;
    }
  }
}

TEST(Session, RefusesAPlannerThatItHasNot) {
  chip::Bytes bytes;
  chip::append(bytes, Name::begin, Begin{255, 0, {}});
  chip::append(bytes, Name::end);
  EXPECT_EQ(outcome(bytes).status, 1);
}

TEST(Session, HasMapsOfTheKnownSizesOnly) {
  for (unsigned size = 0; size <= UINT16_MAX; ++size) {
    chip::Bytes bytes;
    chip::append(bytes, Name::begin, Begin{2, static_cast<std::uint16_t>(size), {}});
    chip::append(bytes, Name::end);
    const bool known = size >= 1024 && size <= planning::kRoomForMap && (size & (size - 1)) == 0;
    ASSERT_EQ(outcome(bytes).status, known ? 0 : 1) << size;
  }
}

TEST(Session, NewParametersAskForANewBeginning) {
  chip::Bytes bytes;
  chip::append_begin(bytes, PlannerKind::skirt, Pose{});
  chip::append(bytes, Name::tick, Tick{});
  chip::append_params(bytes, Params{});
  const std::size_t good = bytes.size();
  chip::append(bytes, Name::tick, Tick{});
  chip::append(bytes, Name::end);
  EXPECT_EQ(outcome(bytes).status, 1);
  bytes.resize(good);
  chip::append(bytes, Name::end);
  EXPECT_EQ(outcome(bytes).status, 0);
}

/// A session whose robot stands at the origin, with an error of the wheels and this policy.
chip::Bytes begun(JumpPolicy policy) {
  Params params;
  params.pose_error.wheel_scale = millionths(5000);
  params.fix_jumps = policy;
  chip::Bytes bytes;
  chip::append_params(bytes, params);
  chip::append_begin(bytes, PlannerKind::skirt, Pose{});
  return bytes;
}

TEST(Session, AnswersAFixByName) {
  chip::Bytes bytes = begun(JumpPolicy::refuse);
  chip::append(bytes, Name::fix, Fix{{0, 0, 0}, 10000, 10000, 1U << 20});
  chip::append(bytes, Name::fix, Fix{{5000000, 0, 0}, 10000, 10000, 1U << 20});
  chip::append(bytes, Name::fix, Fix{{INT32_MAX, 0, 0}, 10000, 10000, 1U << 20});
  chip::append(bytes, Name::end);
  const Outcome o = outcome(bytes);
  EXPECT_EQ(o.status, 0);
  const auto verdict = [&](std::size_t i) {
    return decode<Verdict>(o.output.data() + i * size_of<Verdict>());
  };
  EXPECT_EQ(verdict(0).accepted, 1);
  EXPECT_EQ(verdict(1).accepted, 0);
  EXPECT_EQ(verdict(1).jumps, 1U);
  EXPECT_EQ(verdict(1).refused, 1U);
  EXPECT_EQ(verdict(2).accepted, 0) << "out of range";
  EXPECT_EQ(verdict(2).refused, 1U) << "no jump, but a fault";
}

TEST(Session, AGyroAndAFixNeedARobotAndASoundSigma) {
  for (const bool robot : {false, true}) {
    const chip::Bytes start = robot ? begun(JumpPolicy::accept) : chip::Bytes{};
    chip::Bytes gyro = start;
    chip::append(gyro, Name::gyro, GyroSums{});
    chip::append(gyro, Name::end);
    EXPECT_EQ(outcome(gyro).status, robot ? 0 : 1);
    for (const Fix& fix : {Fix{}, Fix{{}, -1, 0, 0}, Fix{{}, 0, -1, 0}, Fix{{}, 0, 0, 1U << 31}}) {
      chip::Bytes bytes = start;
      chip::append(bytes, Name::fix, fix);
      chip::append(bytes, Name::end);
      const bool sound = fix.sigma_along == 0 && fix.sigma_across == 0 && fix.sigma_heading == 0;
      EXPECT_EQ(outcome(bytes).status, robot && sound ? 0 : 1);
    }
  }
}

TEST(Session, AGyroCountsForOneTick) {
  Params params;
  params.gyro.fitted = Fitted::yes;
  const auto failures = [&](int gyro_ticks) {
    chip::Bytes bytes;
    chip::append_params(bytes, params);
    chip::append_begin(bytes, PlannerKind::skirt, Pose{});
    std::uint16_t samples = 0;
    for (int i = 0; i < 20; ++i) {
      Tick tick;
      tick.now_ms = static_cast<std::uint32_t>(10 * i);
      if (i < gyro_ticks) chip::append(bytes, Name::gyro, GyroSums{{0, ++samples, 0}});
      chip::append(bytes, Name::tick, tick);
    }
    chip::append(bytes, Name::end);
    const Outcome o = outcome(bytes);
    EXPECT_EQ(o.status, 0);
    return decode<Answer>(o.output.data() + 19 * size_of<Answer>()).failures;
  };
  EXPECT_EQ(failures(5), failures(20) + 1) << "gyro_lost, 100 ms after the last one";
}

}  // namespace
}  // namespace whisker::link
