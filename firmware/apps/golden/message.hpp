/// The messages of a golden stream (tests/golden), and what a player answers to some of them.
///
/// | message | body | answer |
/// |---|---|---|
/// | P parameters | a Word for each parameter, in the order of for_each_param | - |
/// | B begin | Begin: planner, its map and pose; a new robot with the last parameters | - |
/// | G goal | Target | - |
/// | L place | Stand | - |
/// | C cancel, R reset | - | - |
/// | X fix | Fix: a pose from outside, before the next tick | - |
/// | T tick | Tick: the time, and the hardware's answers to this tick's calls | Answer |
/// | F fuzzy | Probe: two inputs of the response table | Reaction |
/// | E end | - | Total |
///
/// Bodies are the fields that each() names, in its order, little-endian, two's complement, no padding.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "hal/types.hpp"

namespace whisker::golden {

enum class Name : uint8_t {
  params = 'P',
  begin = 'B',
  goal = 'G',
  place = 'L',
  cancel = 'C',
  reset = 'R',
  fix = 'X',
  tick = 'T',
  fuzzy = 'F',
  end = 'E',
};

/// each(m, f) of a message calls f(name, field) for its fields, in byte order; M may be const.
struct Word {
  uint32_t raw = 0;

  template <class M, class F>
  static constexpr void each(M& m, F& f) {
    f("raw", m.raw);
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
  uint8_t gyro_given = 0;  ///< 0: Gyro::read refuses
  hal::GyroReading gyro{};

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
    f("gyro_given", m.gyro_given);
    f("sum", m.gyro.sum);
    f("samples", m.gyro.samples);
    f("saturated", m.gyro.saturated);
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

/// The bytes of a message's body.
template <class M>
constexpr size_t size_of() noexcept {
  size_t size = 0;
  const auto count = [&size](const char*, const auto& field) { size += sizeof field; };
  const M m{};
  M::each(m, count);
  return size;
}

/// `to` has room for size_of<M>() bytes.
template <class M>
void encode(const M& m, uint8_t* to) noexcept {
  const auto put = [&to](const char*, auto field) {
    auto bits = static_cast<uint64_t>(field);
    for (size_t i = 0; i < sizeof field; ++i, bits >>= 8) *to++ = static_cast<uint8_t>(bits);
  };
  M::each(m, put);
}

/// Reads fields.
class Decoder {
 public:
  explicit Decoder(const uint8_t* from) noexcept : at_(from) {}
  template <class T>
  void operator()(const char*, T& field) noexcept {
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof field; ++i) bits |= static_cast<uint64_t>(*at_++) << (8 * i);
    field = static_cast<T>(bits);
  }

 private:
  const uint8_t* at_;
};

template <class M>
M decode(const uint8_t* from) noexcept {
  M m{};
  Decoder decoder{from};
  M::each(m, decoder);
  return m;
}

}  // namespace whisker::golden
