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

/// Storage for one object created at run time. It is zero-initialised and needs no flash, no guard, and no
/// code before main. The object is never destroyed.
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
