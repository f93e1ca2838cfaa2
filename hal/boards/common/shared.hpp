/// The one way in which an interrupt shares data with the loop: exactly one of the two writes, the other
/// only reads, and what tells the reader that data is there is a single byte, written last.
///
/// A byte is read and written whole on every chip, so no interrupt is ever held off, on 8 bits as on 32.
/// The loop runs on one core; an interrupt runs to its end before the loop goes on.
#pragma once

#include <stdint.h>

namespace whisker::hal::mcu {

/// Keeps the compiler from moving memory accesses across.
inline void compiler_barrier() noexcept { asm volatile("" ::: "memory"); }

/// A queue from one side to the other.
template <class T, uint8_t kSize>
class Ring {
  static_assert(kSize >= 2 && kSize <= 128 && (kSize & (kSize - 1)) == 0, "a power of two, 2..128");

 public:
  /// The writer's. False: full; nothing was kept.
  bool push(const T& value) noexcept {
    const uint8_t head = head_;
    if (static_cast<uint8_t>(head - tail_) == kSize) return false;
    item_[head % kSize] = value;
    compiler_barrier();
    head_ = static_cast<uint8_t>(head + 1);
    return true;
  }
  /// The reader's. False: empty; `out` is untouched.
  bool pop(T& out) noexcept {
    const uint8_t tail = tail_;
    if (head_ == tail) return false;
    compiler_barrier();
    out = item_[tail % kSize];
    compiler_barrier();
    tail_ = static_cast<uint8_t>(tail + 1);
    return true;
  }

 private:
  T item_[kSize] = {};
  volatile uint8_t head_ = 0;
  volatile uint8_t tail_ = 0;
};

/// The newest value of something that an interrupt keeps, read whole by the loop.
template <class T>
class Latest {
 public:
  /// The interrupt's.
  void publish(const T& value) noexcept {
    value_ = value;
    compiler_barrier();
    stamp_ = static_cast<uint8_t>(stamp_ + 1);
  }
  /// The loop's. False: it was published anew during each of the tries; `out` is untouched.
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

/// Events that an interrupt counts and the loop collects, at least once in 255 events.
class Events {
 public:
  /// The interrupt's.
  void happened() noexcept { count_ = static_cast<uint8_t>(count_ + 1); }
  /// The loop's: how many since the last call.
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
