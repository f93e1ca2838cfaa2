#include <fmt/core.h>

#include "host/harness/run/planners.hpp"
#include "tests/golden/messages.hpp"
#include "tests/golden/stream.hpp"
#include "tests/robot/properties/random_params.hpp"
#include "tests/robot/properties/storm_board.hpp"

namespace whisker::golden {
namespace {

using test::Bits;

constexpr int kTicks = 150;  // of a storm

/// Wraps a storm board and records its answers; asked once per tick, before the robot asks.
class Oracle final : public hal::Rangefinders, public hal::Drive {
 public:
  explicit Oracle(test::StormBoard& board) : board_(board) {}

  Tick foresee(Time now) {
    Tick tick;
    tick.now_ms = now.raw();
    tick.ranges_given = board_.read(tick.ranges) ? 1 : 0;
    tick.counts_given = board_.read(tick.counts) ? 1 : 0;
    if (tick.ranges_given == 0) tick.ranges = {};
    if (tick.counts_given == 0) tick.counts = {};
    input_ = tick;
    return tick;
  }
  bool accepted() const { return accepted_; }

  bool read(hal::RangeReadings& out) noexcept override {
    if (input_.ranges_given != 0) out = input_.ranges;
    return input_.ranges_given != 0;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    if (input_.counts_given != 0) out = input_.counts;
    return input_.counts_given != 0;
  }
  bool command(hal::WheelSpeeds speeds) noexcept override { return accepted_ = board_.command(speeds); }

 private:
  test::StormBoard& board_;
  Tick input_;
  bool accepted_ = true;
};

Length any_length(Bits& bits) { return Length::from_raw(static_cast<std::int32_t>(bits.next())); }

planning::Goal random_goal(Bits& bits) {
  if (bits.one_in(10)) return {{any_length(bits), any_length(bits)}, any_length(bits)};
  const auto near = [&] { return millimetres(bits.whole(-4000, 4000)); };
  return {{near(), near()}, millimetres(bits.whole(0, 300))};
}

Time next_tick(Time now, const Params& params, Bits& bits) {
  if (bits.one_in(1000)) return Time::from_raw(static_cast<std::uint32_t>(bits.next()));
  if (bits.one_in(10)) return now + milliseconds(bits.whole(1, longest_gap(params).raw()));
  return now + params.safety.period;
}

/// Random commands of a user, sent to the robot and recorded.
void interfere(Robot& robot, Bits& bits, Bytes& to) {
  const auto set_goal = [&] {
    const planning::Goal goal = random_goal(bits);
    robot.set_goal(goal);
    append_goal(to, goal);
  };
  if (bits.one_in(200)) set_goal();
  if (bits.one_in(400)) {
    robot.cancel();
    append(to, Name::cancel);
  }
  if (bits.one_in(500)) {
    const Pose pose{{any_length(bits), millimetres(bits.whole(-9, 9))},
                    Angle::from_raw(static_cast<std::uint32_t>(bits.next()))};
    robot.place(pose);
    append_place(to, pose);
  }
  if (robot.status().health.fault != Fault::none && bits.one_in(30)) {
    robot.reset();
    append(to, Name::reset);
    set_goal();
  }
}

/// fury: see StormBoard. Seed 1 has the default robot, others a random one.
Stream storm(PlannerKind kind, std::uint64_t seed, int fury) {
  Stream stream{fmt::format("{} storm {}", name(kind), seed), {}, 0};
  Bytes& to = stream.messages;
  Bits bits(seed);
  Params params = seed == 1 ? Params{} : test::random_params(bits);
  params.gyro.fitted = Fitted::no;  // a stream carries none, and not every image has the code
  params.walls.straight = Fitted::no;
  test::StormBoard board(Bits(bits.next()), params, fury);
  Oracle oracle(board);
  const auto planner = make_planner(kind, params);
  Robot robot(oracle, oracle, *planner, params);
  append_params(to, params);
  append_begin(to, kind, Pose{});
  robot.place(Pose{});
  const planning::Goal goal = random_goal(bits);
  robot.set_goal(goal);
  append_goal(to, goal);
  Time now = Time::from_raw(static_cast<std::uint32_t>(bits.next()));
  for (int i = 0; i < kTicks; ++i) {
    now = next_tick(now, params, bits);
    Tick tick = oracle.foresee(now);
    robot.tick(now);
    tick.accepts = oracle.accepted() ? 1 : 0;
    append(to, Name::tick, tick);
    board.pass();
    interfere(robot, bits, to);
  }
  return stream;
}

}  // namespace

std::vector<Stream> storms() {
  std::vector<Stream> all;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const PlannerKind kind : {PlannerKind::boundary, PlannerKind::thesis, PlannerKind::map}) {
      all.push_back(storm(kind, seed, static_cast<int>(seed) % 4));
    }
  }
  return all;
}

}  // namespace whisker::golden
