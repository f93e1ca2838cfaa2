/// docs/link.md is generated from this.
///
/// Messages between a robot on a chip and the companion that simulates its sensors and its wheels.
///
/// The companion sends messages, each a byte that names it and a body; the chip answers some:
///
/// | message | body | answer |
/// |---|---|---|
/// | H hello | - | Greeting |
/// | P parameters | every parameter's raw value, 4 bytes, in the order of for_each_param | - |
/// | B begin | Begin: planner, its map and pose; a new robot with the last parameters | - |
/// | G goal | Target | - |
/// | L place | Stand | - |
/// | C cancel, R reset | - | - |
/// | Y gyro | GyroSums: what the gyro says at the next tick | - |
/// | X fix | Fix: a pose from outside, before the next tick | Verdict |
/// | T tick | Tick: the time, and the hardware's answers to this tick's calls | Answer |
/// | F fuzzy | Probe: two inputs of the response table | Reaction |
/// | E end | - | Total; the chip's program ends |
///
/// Bodies are the fields that each() names, in its order, little-endian, two's complement, no padding.
/// A byte that names no message, or a message out of order, ends the program with an error.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::link {

enum class Name : uint8_t {
  hello = 'H',
  params = 'P',
  begin = 'B',
  goal = 'G',
  place = 'L',
  cancel = 'C',
  reset = 'R',
  gyro = 'Y',
  fix = 'X',
  tick = 'T',
  fuzzy = 'F',
  end = 'E',
};

constexpr uint8_t kVersion = 5;

/// each(m, f) of a message calls f(name, field) for its fields, in byte order; M may be const.
struct Greeting {
  uint8_t version = kVersion;
  uint8_t engine = 0;           ///< 0: look-up
  uint16_t most_map_bytes = 0;  ///< of the largest map that there is room for; 0: none

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("version", m.version);
    f("engine", m.engine);
    f("most_map_bytes", m.most_map_bytes);
  }
};

struct Stand {
  int32_t x = 0;  ///< um
  int32_t y = 0;
  uint32_t heading = 0;  ///< 2^-32 turn

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("x", m.x);
    f("y", m.y);
    f("heading", m.heading);
  }
};

struct Begin {
  uint8_t planner = 0;     ///< its number, see planning::for_each_planner
  uint16_t map_bytes = 0;  ///< of its map, see planning::kMapSizes; 0 for a planner without one
  Stand stand;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("planner", m.planner);
    f("map_bytes", m.map_bytes);
    Stand::each(m.stand, f);
  }
};

struct Target {
  int32_t x = 0;  ///< um
  int32_t y = 0;
  int32_t tolerance = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("x", m.x);
    f("y", m.y);
    f("tolerance", m.tolerance);
  }
};

struct Tick {
  uint32_t now_ms = 0;
  uint8_t ranges_given = 1;  ///< 0: Rangefinders::read refuses
  uint8_t counts_given = 1;  ///< 0: Drive::read refuses
  uint8_t accepts = 1;       ///< 0: Drive::command refuses
  hal::RangeReadings ranges{};
  hal::EncoderCounts counts{};
  uint8_t bumps_given = 1;  ///< 0: Bumper::read refuses
  hal::BumperReading bumps{};

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("now_ms", m.now_ms);
    f("ranges_given", m.ranges_given);
    f("counts_given", m.counts_given);
    f("accepts", m.accepts);
    for (int i = 0; i < hal::kBeams; ++i) {
      f("mm", m.ranges.beam[i].mm);
      f("status", m.ranges.beam[i].status);
      f("age_ms", m.ranges.beam[i].age_ms);
      f("sequence", m.ranges.beam[i].sequence);
    }
    f("count_left", m.counts.left);
    f("count_right", m.counts.right);
    f("bumps_given", m.bumps_given);
    f("pressed", m.bumps.pressed);
  }
};

/// Without it, Gyro::read refuses at the next tick.
struct GyroSums {
  hal::GyroReading reading{};

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("sum", m.reading.sum);
    f("samples", m.reading.samples);
    f("saturated", m.reading.saturated);
  }
};

struct Fix {
  Stand pose;
  int32_t sigma_along = 0;  ///< um
  int32_t sigma_across = 0;
  uint32_t sigma_heading = 0;  ///< 2^-32 turn

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    Stand::each(m.pose, f);
    f("sigma_along", m.sigma_along);
    f("sigma_across", m.sigma_across);
    f("sigma_heading", m.sigma_heading);
  }
};

/// What became of a fix.
struct Verdict {
  uint8_t accepted = 0;
  uint32_t jumps = 0;  ///< Health::fix_jumps
  uint32_t refused = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("accepted", m.accepted);
    f("jumps", m.jumps);
    f("refused", m.refused);
  }
};

/// The status after a tick: every value that may reveal a fault of the core.
struct Answer {
  hal::WheelSpeeds command{};
  uint8_t mode = 0;
  uint8_t why = 0;
  uint8_t outcome = 0;
  uint8_t fault = 0;
  uint8_t danger_count = 0;
  uint8_t looked = 0;
  uint8_t manoeuvre = 0;
  int16_t distance = 0;  ///< D, raw Q7
  int16_t bias = 0;      ///< R
  int16_t turn = 0;      ///< SA, raw Q14
  int16_t step = 0;      ///< SD
  uint8_t cell_distance = 0;
  uint8_t cell_bias = 0;
  Stand pose;
  uint8_t validity[hal::kBeams] = {};
  int32_t echo[hal::kBeams] = {};  ///< um
  uint32_t failures = 0;           ///< the sum of Health's counters
  uint32_t work = 0;               ///< of the call of tick(), see hal::Meter

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("command_left", m.command.left);
    f("command_right", m.command.right);
    f("mode", m.mode);
    f("why", m.why);
    f("outcome", m.outcome);
    f("fault", m.fault);
    f("danger_count", m.danger_count);
    f("looked", m.looked);
    f("manoeuvre", m.manoeuvre);
    f("distance", m.distance);
    f("bias", m.bias);
    f("turn", m.turn);
    f("step", m.step);
    f("cell_distance", m.cell_distance);
    f("cell_bias", m.cell_bias);
    Stand::each(m.pose, f);
    constexpr const char* kValidity[] = {"validity_left", "validity_front", "validity_right"};
    constexpr const char* kEcho[] = {"echo_left", "echo_front", "echo_right"};
    for (int i = 0; i < hal::kBeams; ++i) {
      f(kValidity[i], m.validity[i]);
      f(kEcho[i], m.echo[i]);
    }
    f("failures", m.failures);
    f("work", m.work);
  }
};

struct Probe {
  int16_t distance = 0;
  int16_t bias = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("distance", m.distance);
    f("bias", m.bias);
  }
};

struct Reaction {
  int16_t turn = 0;
  int16_t step = 0;
  uint8_t cell_distance = 0;
  uint8_t cell_bias = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("turn", m.turn);
    f("step", m.step);
    f("cell_distance", m.cell_distance);
    f("cell_bias", m.cell_bias);
  }
};

struct Total {
  uint32_t ticks = 0;
  uint64_t hash = 0;   ///< CommandHash of all ticks' commands and all reactions
  uint32_t stack = 0;  ///< see hal::Meter

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("ticks", m.ticks);
    f("hash", m.hash);
    f("stack", m.stack);
  }
};

}  // namespace whisker::link
