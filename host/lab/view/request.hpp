/// Parser of a browser's request: the header of HTTP/1, GET only.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace whisker::view {

/// A longer header is refused.
constexpr std::size_t kMostHead = std::size_t{16} << 10;

struct Request {
  std::string path;  ///< without a query
  std::string host;
  std::optional<std::string> origin;
  std::string last_event_id;  ///< "" for none
};

/// Result of parsing a header.
struct Asked {
  int status = 200;   ///< any other value: the status of the refusal
  std::string fault;  ///< reason in plain words
  Request request{};
};

/// Collects the bytes of one header.
class Head {
 public:
  /// None: more bytes are needed. Ignores everything after the header.
  std::optional<Asked> add(std::string_view bytes);
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

}  // namespace whisker::view
