#include "hal/ports/slcan/line.hpp"

#include "hal/ports/can_queue.hpp"

namespace whisker::hal::slcan {
namespace {

constexpr uint8_t kBaseDigits = 3;
constexpr uint8_t kExtendedDigits = 8;

uint8_t digit_of(uint32_t value) noexcept {
  const uint32_t low = value & 0xF;
  return static_cast<uint8_t>(low < 10 ? '0' + low : 'A' + (low - 10));
}

/// False if one of them is not a digit.
bool read_digits(const uint8_t* digits, uint8_t count, uint32_t& value) noexcept {
  value = 0;
  for (; count > 0; --count, ++digits) {
    const uint8_t c = *digits;
    uint32_t digit = 0;
    if (c >= '0' && c <= '9') {
      digit = static_cast<uint32_t>(c - '0');
    } else if (c >= 'A' && c <= 'F') {
      digit = static_cast<uint32_t>(c - 'A' + 10);
    } else if (c >= 'a' && c <= 'f') {
      digit = static_cast<uint32_t>(c - 'a' + 10);
    } else {
      return false;
    }
    value = value << 4 | digit;
  }
  return true;
}

}  // namespace

uint8_t write_line(const CanFrame& frame, uint8_t* to) noexcept {
  uint8_t* at = to;
  if (frame.extended) {
    *at++ = frame.remote ? 'R' : 'T';
  } else {
    *at++ = frame.remote ? 'r' : 't';
  }
  for (uint8_t left = frame.extended ? kExtendedDigits : kBaseDigits; left > 0; --left) {
    *at++ = digit_of(frame.id >> (4 * (left - 1)));
  }
  *at++ = digit_of(frame.size);
  for (uint8_t i = 0; !frame.remote && i < frame.size; ++i) {
    *at++ = digit_of(frame.data[i] >> 4U);
    *at++ = digit_of(frame.data[i]);
  }
  return static_cast<uint8_t>(at - to);
}

bool read_line(const uint8_t* line, uint8_t size, CanFrame& out) noexcept {
  if (size == 0) return false;
  CanFrame frame{};
  switch (line[0]) {
    case 't': break;
    case 'T': frame.extended = true; break;
    case 'r': frame.remote = true; break;
    case 'R': frame.extended = frame.remote = true; break;
    default: return false;
  }
  const uint8_t digits = frame.extended ? kExtendedDigits : kBaseDigits;
  const uint8_t head = static_cast<uint8_t>(1 + digits + 1);
  uint32_t bytes = 0;
  if (size < head || !read_digits(line + 1, digits, frame.id) || !read_digits(line + 1 + digits, 1, bytes))
    return false;
  frame.size = static_cast<uint8_t>(bytes);
  if (!well_formed(frame)) return false;
  const uint32_t whole = head + (frame.remote ? 0U : 2 * bytes);
  uint32_t stamp = 0;
  if (size != whole && (size != whole + kTimeStamp || !read_digits(line + whole, kTimeStamp, stamp)))
    return false;
  for (uint8_t i = 0; !frame.remote && i < frame.size; ++i) {
    uint32_t value = 0;
    if (!read_digits(line + head + 2 * i, 2, value)) return false;
    frame.data[i] = static_cast<uint8_t>(value);
  }
  out = frame;
  return true;
}

}  // namespace whisker::hal::slcan
