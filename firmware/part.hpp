/// A part of the robot that an image may leave out.
#pragma once

namespace whisker {

template <class T, bool kBuilt>
class Part {
 public:
  Part() = default;
  template <class Argument>
  explicit Part(Argument& argument) noexcept : part_(argument) {}
  T* operator->() noexcept { return &part_; }
  const T* operator->() const noexcept { return &part_; }

 private:
  T part_;
};

/// Without the code for it, there is no room for it either, and it must not be used.
template <class T>
class Part<T, false> {
 public:
  Part() = default;
  template <class Argument>
  explicit Part(Argument&) noexcept {}
  T* operator->() const noexcept { __builtin_unreachable(); }
};

}  // namespace whisker
