/// The elements of the message table; see messages.hpp.
#pragma once

#include <stdint.h>

#include "firmware/can/value_names.hpp"

namespace whisker::can {

constexpr int8_t kAlways = -1;       ///< Signal::part of a signal in every frame
constexpr int8_t kMultiplexor = -2;  ///< Signal::part of the signal that selects the part

using ValueName = const char* (*)(int64_t raw) noexcept;

struct Signal {
  const char* name = nullptr;
  uint8_t start = 0;       ///< lowest bit
  uint8_t length = 0;      ///< 1..32 bits
  bool is_signed = false;  ///< two's complement
  int64_t min = 0;         ///< raw; a frame with a value outside [min, max] is ignored
  int64_t max = 0;
  const char* factor = nullptr;  ///< physical value = raw x factor
  const char* unit = nullptr;
  const char* about = nullptr;
  int8_t part = kAlways;
  ValueName word = nullptr;  ///< names of the values
};

struct Message {
  const char* name = nullptr;
  uint8_t function = 0;  ///< of the identifier
  uint8_t size = 0;      ///< bytes
  bool from_controller = false;
  bool from_base = false;
  uint16_t cycle_ms = 0;  ///< 0: on an event
  const char* about = nullptr;
  bool from_operator = false;
  const Signal* signals = nullptr;
  uint8_t count = 0;
};

constexpr int64_t kMost4 = 15, kMost8 = 255, kMost16 = 65535, kMost24 = 0xFFFFFF, kMost32 = 0xFFFFFFFF;

}  // namespace whisker::can
