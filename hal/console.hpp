#pragma once

namespace whisker::hal {

/// Text for a person.
class Console {
 public:
  /// Waits until the text is taken.
  virtual void print(const char* text) noexcept = 0;

 protected:
  ~Console() = default;
};

}  // namespace whisker::hal
