/// Members that a chip without room for them leaves out.
#pragma once

namespace whisker {

/// A member of type T.
template <class T, bool kIn>
class MemberIf {
 public:
  MemberIf() = default;
  template <class Argument>
  explicit MemberIf(Argument& argument) noexcept : member_(argument) {}
  T* operator->() noexcept { return &member_; }
  const T* operator->() const noexcept { return &member_; }

 private:
  T member_;
};

/// No member. The code that uses it is behind a constant condition.
template <class T>
class MemberIf<T, false> {
 public:
  MemberIf() = default;
  template <class Argument>
  explicit MemberIf(Argument&) noexcept {}
  T* operator->() const noexcept { return nullptr; }
};

}  // namespace whisker
