#include "hal/boards/stm32f405/reporter.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr uint8_t kFirstTrouble = 2;  // line of a report

}  // namespace

void Reporter::add(const char* text) noexcept {
  while (*text != '\0' && size_ < kLongest - 2) line_[size_++] = *text++;
}

void Reporter::add(uint32_t number) noexcept {
  char digits[11] = {};
  uint8_t at = sizeof digits - 1;
  do {
    digits[--at] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  add(&digits[at]);
}

void Reporter::add_counter(const char* text, uint32_t count) noexcept {
  if (count == 0) return;
  add(text);
  add(" ");
  add(count);
}

void Reporter::next_line(uint32_t now_ms, const Status& status, const char* calibration) noexcept {
  size_ = 0;
  sent_ = 0;
  if (next_ == 0) {
    add("t ");
    add(now_ms);
    add(" ");
    add(planning::name(status.decision.mode));
    add(" ");
    add(planning::name(status.decision.why));
    add(" fault ");
    add(whisker::name(status.health.fault));
  } else if (next_ == 1) {
    if (calibration != nullptr) {
      add("calibration ");
      add(calibration);
    }
  } else if (next_ < kFirstTrouble + kTroubles) {
    const auto trouble = static_cast<Trouble>(next_ - kFirstTrouble);
    add_counter(name(trouble), troubles_.of(trouble));
  } else {
    const CanCounts& can = can_.counts();
    const struct {
      const char* name;
      uint32_t count;
    } lines[] = {{"can not_started", can.not_started}, {"can bus_off", can.bus_offs},
                 {"can expired", can.expired},         {"can refused", can.refused},
                 {"can overrun", can.overrun},         {"late_ticks", status.health.late_ticks}};
    constexpr uint8_t kLines = sizeof lines / sizeof lines[0];
    const uint8_t i = static_cast<uint8_t>(next_ - kTroubles - kFirstTrouble);
    if (i >= kLines) {
      next_ = 0;
      began_ms_ = now_ms;
      return;
    }
    add_counter(lines[i].name, lines[i].count);
  }
  ++next_;
  if (size_ == 0) return;
  line_[size_++] = '\r';
  line_[size_++] = '\n';
}

void Reporter::poll(uint32_t now_ms, const Status& status, const char* calibration) noexcept {
  if (sent_ < size_) {
    if (usart_.offer(static_cast<uint8_t>(line_[sent_]))) ++sent_;
  } else if (next_ != 0 || now_ms - began_ms_ >= kPeriodMs) {
    next_line(now_ms, status, calibration);
  }
}

}  // namespace whisker::hal::stm32f405
