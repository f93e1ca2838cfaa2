#include "hal/ports/slcan/slcan.hpp"

namespace whisker::hal::slcan {
namespace {

constexpr uint8_t kBell = 7;
constexpr uint16_t kBytesPerPoll = 512;  // bounds the work on a line without end
constexpr const char* kOk = "\r";
constexpr const char* kNo = "\a";

bool names_frame(uint8_t c) noexcept { return c == 't' || c == 'T' || c == 'r' || c == 'R'; }

}  // namespace

void Slcan::enter(Phase phase, CanState state) noexcept {
  phase_ = phase;
  state_ = state;
  since_ms_ = now_ms_;
}

void Slcan::begin() noexcept {
  if (role_ == Role::adapter) {
    enter(Phase::open, CanState::active);
    return;
  }
  enter(Phase::settling, CanState::starting);
  // The empty lines end a partial line of an earlier session; no time stamps.
  say("\r\r\rC\rZ0\r");
}

void Slcan::lose() noexcept {
  outbox_.drop_all(counts_);
  if (out_is_frame_ && out_done_ < out_size_) count(counts_.expired);
  out_is_frame_ = false;
  in_size_ = out_size_ = out_done_ = said_size_ = 0;
  skip_ = false;
  enter(Phase::apart, CanState::starting);
}

void Slcan::restart() noexcept { lose(); }

void Slcan::see_time() noexcept {
  const uint32_t passed_ms = now_ms_ - since_ms_;
  if (phase_ == Phase::settling && passed_ms >= kSettleMs) {
    enter(Phase::setting_speed, CanState::starting);
    const char command[] = {'S', speed_, '\r', '\0'};
    say(command);
  } else if ((phase_ == Phase::setting_speed || phase_ == Phase::opening) && passed_ms >= kAnswerMs) {
    see_answer(true);
  }
}

void Slcan::say(const char* text) noexcept {
  uint8_t size = 0;
  while (text[size] != '\0') ++size;
  if (said_size_ + size > static_cast<uint8_t>(sizeof said_)) {
    count(line_counts_.lost_answers);
    return;
  }
  for (uint8_t i = 0; i < size; ++i) said_[said_size_++] = text[i];
}

/// The adapter's answer to the last command.
void Slcan::see_answer(bool accepted) noexcept {
  if (role_ == Role::adapter || phase_ == Phase::settling) return;
  if (!accepted) count(line_counts_.refusals);
  if (phase_ != Phase::setting_speed && phase_ != Phase::opening) return;
  if (!accepted) {
    count(counts_.not_started);
    enter(Phase::refused, CanState::off);
  } else if (phase_ == Phase::setting_speed) {
    enter(Phase::opening, CanState::starting);
    say("O\r");
  } else {
    enter(Phase::open, CanState::active);
  }
}

/// Linux's driver and some adapters report the controller's state: s, a letter, two counters of three digits.
bool Slcan::see_report() noexcept {
  if (in_[0] == 'z' || in_[0] == 'Z' || in_[0] == 'e') return true;
  constexpr uint8_t kReport = 8;
  if (in_[0] != 's' || in_size_ != kReport) return false;
  if (!on_bus()) return true;
  switch (in_[1]) {
    case 'a':
    case 'w': state_ = CanState::active; return true;
    case 'p': state_ = CanState::passive; return true;
    case 'b':
      count(counts_.bus_offs);
      outbox_.drop_all(counts_);
      state_ = CanState::bus_off;
      return true;
    default: return false;
  }
}

void Slcan::see_command() noexcept {
  const bool open = phase_ == Phase::open;
  switch (in_[0]) {
    case 'S':
    case 's': say(open ? kNo : kOk); return;
    case 'O':
      say(open ? kNo : kOk);
      enter(Phase::open, CanState::active);
      return;
    case 'C':
      say(open ? kOk : kNo);
      outbox_.drop_all(counts_);
      enter(Phase::closed, CanState::starting);
      return;
    case 'V': say("V0101\r"); return;
    case 'N': say("NWHSK\r"); return;
    case 'F': say("F00\r"); return;
    case 'Z': say(in_size_ == 2 && in_[1] == '0' ? kOk : kNo); return;  // no time stamps
    default: count(line_counts_.bad_lines); say(kNo);
  }
}

void Slcan::see_frame() noexcept {
  CanFrame frame{};
  const bool good = read_line(in_, in_size_, frame);
  if (!good) count(line_counts_.bad_lines);
  // An adapter that receives or sends frames is open.
  if (good && phase_ == Phase::opening) see_answer(true);
  const bool taken = good && phase_ == Phase::open && on_bus();
  if (taken) inbox_.push(frame, counts_);
  if (role_ == Role::host) return;
  if (!taken) {
    say(kNo);
  } else {
    say(frame.extended ? "Z\r" : "z\r");
  }
}

void Slcan::see_line() noexcept {
  if (in_size_ == 0) {
    if (!skip_) {
      see_answer(true);
    } else {
      count(line_counts_.bad_lines);
      if (role_ == Role::adapter) say(kNo);
    }
  } else if (names_frame(in_[0])) {
    see_frame();
  } else if (role_ == Role::adapter) {
    see_command();
  } else if (!see_report()) {
    count(line_counts_.bad_lines);
  }
}

void Slcan::fetch() noexcept {
  for (uint16_t left = kBytesPerPoll; left > 0 && !inbox_.full(); --left) {
    uint8_t byte = 0;
    if (line_.take(&byte, 1) == 0) return;
    if (byte == kBell && role_ == Role::host) {
      see_answer(false);
      in_size_ = 0;
      skip_ = false;
    } else if (byte == kEnd) {
      see_line();
      in_size_ = 0;
      skip_ = false;
    } else if (byte == '\n' || skip_) {
      continue;
    } else if (in_size_ == kLongestLine) {
      in_size_ = 0;
      skip_ = true;
    } else {
      in_[in_size_++] = byte;
    }
  }
}

void Slcan::flush() noexcept {
  for (;;) {
    if (out_done_ == out_size_) {
      out_done_ = out_size_ = 0;
      out_is_frame_ = false;
      if (said_size_ > 0) {
        const uint8_t size = said_size_ < sizeof out_ ? said_size_ : uint8_t{sizeof out_};
        for (uint8_t i = 0; i < size; ++i) out_[i] = static_cast<uint8_t>(said_[i]);
        for (uint8_t i = size; i < said_size_; ++i) said_[i - size] = said_[i];
        said_size_ = static_cast<uint8_t>(said_size_ - size);
        out_size_ = size;
      } else if (const CanOutbox::Waiting* next = outbox_.first(); next != nullptr && on_bus()) {
        out_size_ = write_line(next->frame, out_);
        out_[out_size_++] = kEnd;
        out_is_frame_ = true;
        outbox_.pop();
      } else {
        return;
      }
    }
    const size_t taken = line_.offer(out_ + out_done_, static_cast<size_t>(out_size_ - out_done_));
    if (taken == 0) return;
    out_done_ = static_cast<uint8_t>(out_done_ + taken);
    if (out_done_ == out_size_ && out_is_frame_) count(counts_.sent);
  }
}

bool Slcan::send(const CanFrame& frame, uint8_t lifetime_ms) noexcept {
  return outbox_.put(frame, lifetime_ms, on_bus(), counts_);
}

bool Slcan::receive(CanFrame& out) noexcept { return inbox_.pop(out, counts_); }

void Slcan::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  outbox_.expire(now_ms, counts_);
  if (!line_.ready()) {
    lose();
    return;
  }
  if (phase_ == Phase::apart) begin();
  see_time();
  fetch();
  flush();
}

}  // namespace whisker::hal::slcan
