#pragma once

namespace whisker::hal {

/// Text output for people.
class Console {
 public:
  /// Blocks until the text is accepted.
  virtual void print(const char* text) noexcept = 0;

 protected:
  ~Console() = default;
};

}  // namespace whisker::hal
