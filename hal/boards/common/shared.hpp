/// The only way in which an interrupt shares data with the main loop: exactly one of the two writes, the
/// other only reads, and a single byte, written last, tells the reader that data is present.
///
/// Reads and writes of a byte are atomic on every chip, with 8 or 32 bits, so no interrupt is ever disabled.
/// The loop runs on one core; an interrupt completes before the loop continues.
#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// Compiler barrier for memory accesses.
inline void compiler_barrier() noexcept { asm volatile("" ::: "memory"); }

/// A queue with one writer and one reader.
template <class T, uint16_t kSize>
class Ring {
  static_assert(kSize >= 2 && kSize <= 32768 && (kSize & (kSize - 1)) == 0, "a power of two, 2..32768");

 public:
  /// For the writer. False: full; nothing was stored.
  bool push(const T& value) noexcept {
    const uint16_t head = head_;
    if (static_cast<uint16_t>(head - tail_) == kSize) return false;
    item_[head % kSize] = value;
    compiler_barrier();
    head_ = static_cast<uint16_t>(head + 1);
    return true;
  }
  /// For the reader. False: empty; `out` is unchanged.
  bool pop(T& out) noexcept {
    if (size() == 0) return false;
    out = at(0);
    drop(1);
    return true;
  }
  /// For the reader: the values that wait, the one that is i places behind the first, and the first ones
  /// gone.
  uint16_t size() const noexcept {
    const uint16_t size = static_cast<uint16_t>(head_ - tail_);
    compiler_barrier();
    return size;
  }
  const T& at(uint16_t i) const noexcept { return item_[(tail_ + i) % kSize]; }
  void drop(uint16_t count) noexcept {
    compiler_barrier();
    tail_ = static_cast<uint16_t>(tail_ + count);
  }

 private:
  T item_[kSize] = {};
  volatile uint16_t head_ = 0;
  volatile uint16_t tail_ = 0;
};

/// The newest value from an interrupt; the loop reads it consistently.
template <class T>
class Latest {
 public:
  /// For the interrupt.
  void publish(const T& value) noexcept {
    value_ = value;
    compiler_barrier();
    stamp_ = static_cast<uint8_t>(stamp_ + 1);
  }
  /// For the loop. False: a new value was published during each of the tries; `out` is unchanged.
  bool read(T& out) const noexcept {
    for (uint8_t tries = 0; tries < kTries; ++tries) {
      const uint8_t before = stamp_;
      compiler_barrier();
      const T copy = value_;
      compiler_barrier();
      if (stamp_ == before) {
        out = copy;
        return true;
      }
    }
    return false;
  }
  /// Changes with every publish(), modulo 256.
  uint8_t stamp() const noexcept { return stamp_; }

 private:
  static constexpr uint8_t kTries = 8;
  T value_{};
  volatile uint8_t stamp_ = 0;
};

/// Events that an interrupt counts. The loop must collect them before 255 have occurred.
class Events {
 public:
  /// For the interrupt.
  void happened() noexcept { count_ = static_cast<uint8_t>(count_ + 1); }
  /// For the loop: number of events since the last call.
  uint8_t collect() noexcept {
    const uint8_t now = count_;
    const uint8_t fresh = static_cast<uint8_t>(now - seen_);
    seen_ = now;
    return fresh;
  }

 private:
  volatile uint8_t count_ = 0;
  uint8_t seen_ = 0;
};

}  // namespace whisker::hal::mcu
