#include <fmt/core.h>

#include "tests/golden/stream.hpp"

namespace whisker::golden {

Bytes recording(const std::vector<Stream>& streams, std::string& index) {
  Bytes bytes;
  index.clear();
  for (const Stream& stream : streams) {
    index += fmt::format("{} {}\n", bytes.size(), stream.name);
    bytes.insert(bytes.end(), stream.messages.begin(), stream.messages.end());
  }
  append(bytes, Name::end);
  return bytes;
}

}  // namespace whisker::golden
