/// A minimal client on a socket, so that it can also misbehave.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace whisker::view::testing {

inline constexpr const char* kHere = "127.0.0.1";

struct Answer {
  int status = 0;  ///< 0: no answer
  std::string head;
  std::string body;

  /// "" if there is no such header.
  std::string header(std::string_view name) const;
};

/// One connection to this computer.
class Line {
 public:
  /// receive_buffer 0: the kernel's default.
  explicit Line(int port, int receive_buffer = 0);
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// Number of bytes that the other end received before it closed.
  std::size_t send(std::string_view bytes) const;
  /// Some received bytes; "" at the end or after the time-out.
  std::string read_some(std::chrono::milliseconds patience = std::chrono::seconds(60)) const;
  /// All bytes until the other end closes.
  std::string read_all() const;
  /// Whether the other end closes within this time.
  bool is_left(std::chrono::milliseconds patience) const;

 private:
  int socket_;
};

/// The head of a request, without the final empty line; `more` has complete lines.
std::string ask(int port, const std::string& path, const std::string& more = "");
Answer answer_of(const std::string& bytes);
Answer get(int port, const std::string& path, const std::string& more = "");

}  // namespace whisker::view::testing
