/// Any accepted parameters with any goals, places, fixes, commands, readings, counts and gaps, and any
/// refused ones: the sanitizers and the preconditions of the core find nothing, refused parameters leave the
/// wheels at rest, and no command exceeds the speed of the wheels.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "firmware/guard.hpp"
#include "firmware/params/words.hpp"
#include "firmware/planning/planners.hpp"
#include "firmware/robot.hpp"

namespace {

using namespace whisker;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Takes the bytes of the input in order; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  bool ended() const { return at_ == end_; }
  std::uint8_t next() { return at_ < end_ ? *at_++ : std::uint8_t{0}; }
  std::uint32_t word() {
    std::uint32_t all = 0;
    for (int i = 0; i < 4; ++i) all = all << 8 | next();
    return all;
  }
  Length length() { return Length::from_raw(static_cast<std::int32_t>(word())); }
  /// Mostly near.
  Length place() { return next() < 240 ? millimetres(next() * 40 - 5100) : length(); }
  Angle angle() { return Angle::from_raw(word()); }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

/// The ends of each parameter's own range.
struct Ends {
  std::array<std::int64_t, kParams> low{}, high{};
  std::size_t at = 0;

  template <class T>
  void number(const char*, T&, T least, T most) {
    low[at] = least.raw();
    high[at++] = most.raw();
  }
  void count(const char*, std::int32_t&, std::int32_t least, std::int32_t most) {
    low[at] = least;
    high[at++] = most;
  }
  template <class E>
  void choice(const char*, E&, const char* const*, int names) {
    high[at++] = names - 1;
  }
  void derived(const char*) { ++at; }
};

const Ends& ends() {
  static const Ends all = [] {
    Params p;
    Ends found;
    for_each_param(p, found);
    return found;
  }();
  return all;
}

std::uint32_t value_within(std::size_t param, Bytes& bytes) {
  const std::int64_t low = ends().low[param], high = ends().high[param];
  switch (bytes.next() % 4) {
    case 0: return static_cast<std::uint32_t>(low);
    case 1: return static_cast<std::uint32_t>(high);
    case 2: return static_cast<std::uint32_t>(low + (high - low) * bytes.next() / 255);
    default:  // as often near the low end as far away
      return static_cast<std::uint32_t>(low + (bytes.word() >> bytes.next() % 32) % (high - low + 1));
  }
}

/// Accepted ones after each change, unless `wild`.
Params params_from(Bytes& bytes, bool wild) {
  Params params;
  for (int changes = bytes.next() % 64; changes > 0; --changes) {
    const int param = bytes.next() % kParams;
    const Params before = params;
    set_raw_param(params, param, wild ? bytes.word() : value_within(static_cast<std::size_t>(param), bytes));
    if (!wild && check(params) != ParamFault::none) params = before;
  }
  return params;
}

/// Its wheels follow each command at once, until the input says otherwise.
class Board final : public hal::Rangefinders, public hal::Drive, public hal::Bumper, public hal::Gyro {
 public:
  explicit Board(const Params& params) : params_(params) {
    for (hal::RangeReading& beam : shown_.beam) beam = {0, hal::RangeStatus::clear, 20, 0};
  }
  void pass(std::int32_t ms) {
    const std::int64_t nm[2] = {std::int64_t{command_.left} * 100 * ms,
                                std::int64_t{command_.right} * 100 * ms};
    for (int wheel = 0; wheel < 2; ++wheel) way_nm_[wheel] += nm[wheel];
    gyro_.samples = static_cast<std::uint16_t>(gyro_.samples + 1);
    for (hal::RangeReading& beam : shown_.beam) beam.sequence = (beam.sequence + 1) & 15;
  }
  void disturb(Bytes& bytes) {
    const std::uint8_t what = bytes.next();
    hal::RangeReading& beam = shown_.beam[what % 3];
    switch (what / 3 % 8) {
      case 0:
      case 1:
        beam.mm = static_cast<std::uint16_t>(bytes.next() * 10);
        beam.status = hal::RangeStatus::ok;
        break;
      case 2: beam.mm = static_cast<std::uint16_t>(bytes.word()); break;
      case 3: beam.status = static_cast<hal::RangeStatus>(bytes.next() % 6); break;
      case 4: beam.age_ms = bytes.next(); break;
      case 5: way_nm_[what & 1] += static_cast<std::int32_t>(bytes.word()); break;
      case 6:
        gyro_.sum += bytes.word();
        gyro_.saturated = bytes.next();
        break;
      default: refuses_ = bytes.next(); break;
    }
  }
  bool read(hal::RangeReadings& out) noexcept override {
    out = shown_;
    return (refuses_ & 1) == 0;
  }
  bool read(hal::EncoderCounts& out) noexcept override {
    out = {count(0), count(1)};
    return (refuses_ & 2) == 0;
  }
  bool command(hal::WheelSpeeds speeds) noexcept override {
    command_ = speeds;
    return (refuses_ & 4) == 0;
  }
  bool read(hal::BumperReading& out) noexcept override {
    out.pressed = refuses_ >> 5;
    return (refuses_ & 8) == 0;
  }
  bool read(hal::GyroReading& out) noexcept override {
    out = gyro_;
    return (refuses_ & 16) == 0;
  }
  hal::WheelSpeeds commanded() const { return command_; }

 private:
  std::uint32_t count(int wheel) const {
    const std::int64_t per_m = std::clamp(params_.wheels.counts_per_metre, 100, 1000000);
    return static_cast<std::uint32_t>(way_nm_[wheel] / 1000 * per_m / 1000000) % hal::kEncoderModulus;
  }
  const Params& params_;
  hal::RangeReadings shown_{};
  hal::GyroReading gyro_{};
  hal::WheelSpeeds command_{};
  std::int64_t way_nm_[2] = {0, 0};
  std::uint8_t refuses_ = 0;
};

class Session {
 public:
  Session(Bytes& bytes, bool wild)
      : params_(params_from(bytes, wild)),
        refused_(check(params_) != ParamFault::none),
        now_(Time::from_raw(bytes.word())) {}

  template <class Step>
  void run(Bytes& bytes, const Step& step) {
    constexpr int kMostTicks = 3000;
    for (int ticks = 0; ticks < kMostTicks && !bytes.ended();) {
      const std::uint8_t what = bytes.next();
      if (what >= 64 && what < 128) {
        board_.disturb(bytes);
        continue;
      }
      // Many ticks of the promised period, or one that is late or jumps.
      const bool calm = what < 64;
      const int times = calm ? 1 + what : 1;
      if (!calm) step(what, bytes);
      ticks += times;
      for (int i = 0; i < times; ++i) tick(calm ? params_.safety.period.raw() : bytes.next(), step);
    }
  }
  const Params& params() const { return params_; }
  Board& board() { return board_; }
  Time now() const { return now_; }

 private:
  template <class Step>
  void tick(std::int32_t ms, const Step& step) {
    const std::int32_t gap = std::clamp(ms, 1, 100);
    now_ = now_ + milliseconds(gap);
    step.tick(now_);
    const hal::WheelSpeeds sent = board_.commanded();
    const std::int32_t most = refused_ ? 0 : params_.wheels.max_speed.raw() / 100 + 1;
    require(std::abs(sent.left) <= most && std::abs(sent.right) <= most);
    board_.pass(gap);
  }

  const Params params_;
  const bool refused_;
  Time now_;
  Board board_{params_};
};

struct RobotStep {
  Robot& robot;
  void operator()(std::uint8_t what, Bytes& bytes) const {
    switch (what % 8) {
      case 0:
      case 1: robot.set_goal({{bytes.place(), bytes.place()}, millimetres(bytes.next())}); break;
      case 2: robot.place({{bytes.place(), bytes.place()}, bytes.angle()}); break;
      case 3:
      case 4: {
        // Near the estimate, or anywhere.
        const Pose& at = robot.status().pose;
        Pose fix{at.at + Vec{millimetres(bytes.next() - 128), millimetres(bytes.next() - 128)},
                 at.heading + Angle::from_raw(static_cast<std::uint32_t>(bytes.next()) << 16)};
        if (bytes.next() > 250) fix = {{bytes.length(), bytes.length()}, bytes.angle()};
        const auto sigma = [&] {
          const std::uint8_t how = bytes.next();
          return how < 64 ? Length{} : how < 240 ? micrometres(bytes.next() * 100) : bytes.length();
        };
        robot.correct(fix, {sigma(), sigma(), angle_of(sigma(), 1_m)});
        break;
      }
      case 5: robot.reset(); break;
      case 6: robot.cancel(); break;
      default: robot.braked_elsewhere(); break;
    }
  }
  void tick(Time now) const { robot.tick(now); }
};

struct GuardStep {
  Guard& guard;
  const Session& session;
  void operator()(std::uint8_t what, Bytes& bytes) const {
    switch (what % 8) {
      case 5: guard.reset(); break;
      case 6: guard.vouch(bytes.place()); break;
      case 7: guard.braked_elsewhere(); break;
      default: {
        const auto speed = [&] { return static_cast<std::int32_t>(bytes.word()) >> bytes.next() % 24; };
        guard.command({Speed::from_raw(speed()), AngularRate::from_raw(speed())}, session.now());
      }
    }
  }
  void tick(Time now) const { guard.tick(now); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t kind = bytes.next();
  Session session(bytes, (kind & 8) != 0);
  Board& board = session.board();
  const Params& params = session.params();
  if (kind % 8 < 2) {
    Guard guard(board, board, params, &board);
    session.run(bytes, GuardStep{guard, session});
    return 0;
  }
  const auto drive = [&](planning::Planner& planner) {
    Robot robot(board, board, planner, params, &board, &board);
    session.run(bytes, RobotStep{robot});
  };
  if (kind % 8 < 5) {
    const auto made = std::make_unique<planning::TableMapPlanner<16384>>(params, fuzzy::kDefaultTable);
    drive(planning::planner_in(*made));
  } else if (kind % 8 < 7) {
    planning::TableBoundaryPlanner made(params, fuzzy::kDefaultTable);
    drive(planning::planner_in(made));
  } else {
    planning::ThesisPlanner made(params, fuzzy::kDefaultTable);
    drive(made);
  }
  return 0;
}
