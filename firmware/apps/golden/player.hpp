/// Plays a golden stream to a robot: its sensors and wheels answer as recorded.
#pragma once

#include "firmware/apps/command_hash.hpp"
#include "firmware/apps/golden/message.hpp"
#include "firmware/apps/static_storage.hpp"
#include "firmware/params/words.hpp"
#include "firmware/planning/default_planner.hpp"
#include "firmware/planning/planners.hpp"
#include "firmware/robot.hpp"
#include "hal/board.hpp"

namespace whisker::golden {

inline Pose pose_of(const Stand& s) noexcept {
  return {{Length::from_raw(s.x), Length::from_raw(s.y)}, Angle::from_raw(s.heading)};
}

inline uint32_t failures(const Health& h) noexcept {
  return h.range_refused + h.range_invalid + h.range_stale + h.range_stuck + h.range_out_of_range +
         h.drive_refused + h.encoder_refused + h.encoder_jumps + h.wheel_stalls + h.unsteady_looks +
         h.no_progress + h.pose_out_of_range + h.wheel_runaways + h.late_ticks + h.clock_jumps +
         h.bumper_refused + h.bumper_stuck + h.gyro_lost + h.gyro_saturated + h.fix_jumps + h.fixes_refused;
}

inline Answer answer_of(const Status& status) noexcept {
  const planning::Decision& d = status.decision;
  Answer a;
  a.command = status.command;
  a.mode = static_cast<uint8_t>(d.mode);
  a.why = static_cast<uint8_t>(d.why);
  a.outcome = static_cast<uint8_t>(d.outcome);
  a.fault = static_cast<uint8_t>(status.health.fault);
  a.danger_count = d.danger_count;
  a.looked = d.looked ? 1 : 0;
  a.manoeuvre = static_cast<uint8_t>(d.manoeuvre.kind);
  a.distance = d.inputs.distance.raw();
  a.bias = d.inputs.bias.raw();
  a.turn = d.response.turn.raw();
  a.step = d.response.step.raw();
  a.cell_distance = d.response.cell.distance;
  a.cell_bias = d.response.cell.bias;
  a.pose = {status.pose.at.x.raw(), status.pose.at.y.raw(), status.pose.heading.raw()};
  for (int i = 0; i < hal::kBeams; ++i) {
    a.validity[i] = static_cast<uint8_t>(status.echoes.beam[i].validity);
    a.echo[i] = status.echoes.beam[i].distance.raw();
  }
  a.failures = failures(status.health);
  return a;
}

/// Answers every call as in the tick that is shown.
class RecordedBoard final : public hal::Rangefinders,
                            public hal::Bumper,
                            public hal::Drive,
                            public hal::Gyro {
 public:
  void show(const Tick& tick) noexcept { tick_ = tick; }

  bool read(hal::RangeReadings& out) noexcept override { return take(tick_.ranges_given, tick_.ranges, out); }
  bool read(hal::EncoderCounts& out) noexcept override { return take(tick_.counts_given, tick_.counts, out); }
  bool read(hal::BumperReading& out) noexcept override { return take(tick_.bumps_given, tick_.bumps, out); }
  bool read(hal::GyroReading& out) noexcept override { return take(tick_.gyro_given, tick_.gyro, out); }
  bool command(hal::WheelSpeeds) noexcept override { return tick_.accepts != 0; }

 private:
  template <class T>
  static bool take(uint8_t given, const T& recorded, T& out) noexcept {
    if (given != 0) out = recorded;
    return given != 0;
  }
  Tick tick_;
};

class Player {
 public:
  Player(hal::ByteStream& stream, hal::Meter& meter) noexcept
      : stream_(stream), meter_(meter), overhead_(hal::overhead(meter)) {}

  /// Answers up to the end of the stream. 0: all of it; 1: it breaks off, or is no stream. Call it once.
  int run() noexcept {
    while (!ended_) {
      uint8_t name = 0;
      if (!stream_.read(&name, 1) || !execute(static_cast<Name>(name))) return 1;
    }
    return 0;
  }

 private:
  bool execute(Name name) noexcept {
    switch (name) {
      case Name::params:
        for (int i = 0; i < kParams; ++i) {
          if (!on<Word>([&](const Word& word) { set_raw_param(params_, i, word.raw); })) return false;
        }
        return true;
      case Name::begin: return on<Begin>([&](const Begin& what) { begin(what); }) && robot_ != nullptr;
      case Name::fuzzy: return on<Probe>([&](const Probe& what) { probe(what); });
      case Name::end: return end();
      default: return robot_ != nullptr && instruct(*robot_, name);
    }
  }
  bool instruct(Robot& robot, Name name) noexcept {
    switch (name) {
      case Name::goal:
        return on<Target>([&](const Target& what) {
          robot.set_goal(
              {{Length::from_raw(what.x), Length::from_raw(what.y)}, Length::from_raw(what.tolerance)});
        });
      case Name::place: return on<Stand>([&](const Stand& what) { robot.place(pose_of(what)); });
      case Name::cancel: robot.cancel(); return true;
      case Name::reset: robot.reset(); return true;
      case Name::fix:
        return on<Fix>([&](const Fix& what) {
          robot.correct(pose_of(what.pose),
                        {Length::from_raw(what.sigma_along), Length::from_raw(what.sigma_across),
                         Angle::from_raw(what.sigma_heading)});
        });
      case Name::tick: return on<Tick>([&](const Tick& what) { tick(robot, what); });
      default: return false;
    }
  }
  void begin(const Begin& what) noexcept {
    const auto make = [this](auto type) -> planning::Planner* {
      if constexpr (type.kMapBytes <= planning::kRoomForMap) {
        using Type = typename decltype(type)::Type;
        return &planning::planner_in(room_for_planner_.make<Type>(params_, fuzzy::kDefaultTable));
      }
      return nullptr;
    };
    robot_ = nullptr;
    const auto planner = planning::with_planner<planning::Planner*>(what.planner, what.map_bytes, make);
    if (planner == nullptr) return;
    robot_ = &room_for_robot_.make<Robot>(board_, board_, *planner, params_, &board_, &board_);
    robot_->place(pose_of(what.stand));
  }
  void tick(Robot& robot, const Tick& what) noexcept {
    board_.show(what);
    const uint32_t before = meter_.stamp();
    const Status& status = robot.tick(Time::from_raw(what.now_ms));
    const uint32_t after = meter_.stamp();
    ++ticks_;
    hash_.add(status.command);
    Answer answer = answer_of(status);
    answer.work = meter_.between(before, after) - overhead_;
    say(answer);
  }
  void probe(const Probe& what) noexcept {
    const fuzzy::Engine engine{fuzzy::kDefaultTable};
    const fuzzy::Response r = engine({Q7::from_raw(what.distance), Q7::from_raw(what.bias)});
    hash_.add(r.turn.raw());
    hash_.add(r.step.raw());
    say(Reaction{r.turn.raw(), r.step.raw(), r.cell.distance, r.cell.bias});
  }
  bool end() noexcept {
    ended_ = true;
    say(Total{ticks_, hash_.value(), meter_.deepest_stack()});
    return heard_;
  }

  /// Reads a body, and acts on it.
  template <class M, class F>
  bool on(const F& act) noexcept {
    uint8_t bytes[size_of<M>()];
    if (!stream_.read(bytes, sizeof bytes)) return false;
    act(decode<M>(bytes));
    return heard_;
  }
  template <class M>
  void say(const M& answer) noexcept {
    uint8_t bytes[size_of<M>()];
    encode(answer, bytes);
    heard_ = heard_ && stream_.write(bytes, sizeof bytes);
  }

  hal::ByteStream& stream_;
  hal::Meter& meter_;
  uint32_t overhead_;
  Params params_;
  RecordedBoard board_;
  Robot* robot_ = nullptr;
  StaticStorage<planning::largest_planner(planning::kRoomForMap)> room_for_planner_;
  StaticStorage<sizeof(Robot)> room_for_robot_;
  CommandHash hash_;
  uint32_t ticks_ = 0;
  bool heard_ = true;
  bool ended_ = false;
};

/// Plays the emulator's standard input and answers on its standard output. Returns the program's status.
inline int play(hal::Meter& meter) noexcept {
  static StaticStorage<sizeof(Player)> room;
  return room.make<Player>(hal::board().host, meter).run();
}

}  // namespace whisker::golden
