/// What a browser asks: the head of an HTTP/1 request, with GET and nothing else.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace whisker::view {

/// A longer head is refused.
constexpr std::size_t kMostHead = std::size_t{16} << 10;

struct Request {
  std::string path;  ///< without a query
  std::string host;
  std::optional<std::string> origin;
  std::string last_event_id;  ///< "" for none
};

/// What came of reading a head.
struct Asked {
  int status = 200;   ///< anything else: the status to refuse it with
  std::string fault;  ///< why, in plain words
  Request request{};
};

/// Collects the bytes of one head, as they come.
class Head {
 public:
  /// None: more bytes are needed. What follows the head is left out.
  std::optional<Asked> add(std::string_view bytes);
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

}  // namespace whisker::view
