/// The board of the tests as the functions that firmware/c/whisker.h wants.
#pragma once

#include "firmware/c/whisker.h"
#include "tests/robot/fake_board.hpp"

namespace whisker::test {

inline FakeBoard& board_of(void* user) { return *static_cast<FakeBoard*>(user); }

/// extras: with bump switches and a gyro. The board must outlive it.
inline whisker_board c_board(FakeBoard& board, bool extras = false) {
  whisker_board callbacks{};
  callbacks.user = &board;
  callbacks.ranges = [](void* user, whisker_range readings[3]) {
    hal::RangeReadings now{};
    if (!board_of(user).read(now)) return false;
    for (int i = 0; i < 3; ++i) {
      const hal::RangeReading& r = now.beam[i];
      readings[i] = {r.mm, static_cast<std::uint8_t>(r.status), r.age_ms, r.sequence};
    }
    return true;
  };
  callbacks.counts = [](void* user, std::uint32_t* left, std::uint32_t* right) {
    hal::EncoderCounts now{};
    if (!board_of(user).read(now)) return false;
    *left = now.left;
    *right = now.right;
    return true;
  };
  callbacks.speeds = [](void* user, std::int16_t left, std::int16_t right) {
    return board_of(user).command({left, right});
  };
  if (!extras) return callbacks;
  callbacks.bumper = [](void* user, std::uint8_t* pressed) {
    *pressed = board_of(user).pressed;
    return !board_of(user).bumper_refuses;
  };
  callbacks.gyro = [](void* user, whisker_gyro* reading) {
    hal::GyroReading now{};
    const bool answers = board_of(user).read(now);
    *reading = {now.sum, now.samples, now.saturated};
    return answers;
  };
  return callbacks;
}

}  // namespace whisker::test
