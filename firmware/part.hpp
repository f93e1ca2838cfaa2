/// The part of the core that an image may leave out: the code for a gyro and the bound of the pose. The
/// toolchain file of a chip without room for it sets WHISKER_GYRO to 0.
#pragma once

#ifndef WHISKER_GYRO
#define WHISKER_GYRO 1
#endif

namespace whisker {

constexpr bool kGyroBuilt = WHISKER_GYRO != 0;

/// A member that exists only if its part is built. Without the code for it, there is no room for it either,
/// and it must not be used.
template <class T, bool kBuilt>
class Part {
 public:
  constexpr Part() noexcept {}  // NOLINT(modernize-use-equals-default)
  template <class Argument>
  explicit Part(Argument& argument) noexcept : part_(argument) {}
  T* operator->() noexcept { return &part_; }
  const T* operator->() const noexcept { return &part_; }

 private:
  T part_;
};

template <class T>
class Part<T, false> {
 public:
  Part() = default;
  template <class Argument>
  explicit Part(Argument&) noexcept {}
  T* operator->() const noexcept { __builtin_unreachable(); }
};

}  // namespace whisker
