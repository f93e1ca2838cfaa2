#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker {

struct StorageAddress {
  void* at;
};

}  // namespace whisker

/// Some freestanding compilers have no <new>.
inline void* operator new(size_t, whisker::StorageAddress room) noexcept { return room.at; }

namespace whisker {

/// Room for one object that is made while the program runs. Itself all zero and without a constructor that
/// runs: it needs no flash, no guard, and no code before main. Nothing is ever destroyed.
template <size_t kSize>
class StaticStorage {
 public:
  template <class T, class... Arguments>
  T& make(Arguments&&... arguments) noexcept {
    static_assert(sizeof(T) <= kSize && alignof(T) <= 8);
    return *new (StorageAddress{bytes_}) T(static_cast<Arguments&&>(arguments)...);
  }

 private:
  alignas(8) uint8_t bytes_[kSize] = {};
};

}  // namespace whisker
