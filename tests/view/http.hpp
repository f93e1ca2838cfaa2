/// A plain client: no more than a socket, so that it can also misbehave.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace whisker::view::testing {

inline constexpr const char* kHere = "127.0.0.1";

struct Answer {
  int status = 0;  ///< 0: none came
  std::string head;
  std::string body;

  /// "" where there is none.
  std::string header(std::string_view name) const;
};

/// One connection to this computer.
class Line {
 public:
  /// receive_buffer 0: the kernel's own choice.
  explicit Line(int port, int receive_buffer = 0);
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// How many of the bytes the other end has taken before it hung up.
  std::size_t send(std::string_view bytes) const;
  /// Some of what comes; "" when nothing more will, or nothing came for so long.
  std::string read_some(std::chrono::milliseconds patience = std::chrono::seconds(60)) const;
  /// All up to the other end's last word.
  std::string read_all() const;
  /// The other end has hung up, within so long.
  bool is_left(std::chrono::milliseconds patience) const;

 private:
  int socket_;
};

/// The head of a request, without its last empty line; `more` has whole lines.
std::string ask(int port, const std::string& path, const std::string& more = "");
Answer answer_of(const std::string& bytes);
Answer get(int port, const std::string& path, const std::string& more = "");

}  // namespace whisker::view::testing
