#include <fmt/core.h>

#include "tests/golden/stream.hpp"

namespace whisker::golden {

chip::Bytes recording(const std::vector<Stream>& streams, std::string& index) {
  chip::Bytes bytes;
  chip::append(bytes, link::Name::hello);
  index.clear();
  for (const Stream& stream : streams) {
    index += fmt::format("{} {}\n", bytes.size(), stream.name);
    bytes.insert(bytes.end(), stream.messages.begin(), stream.messages.end());
  }
  chip::append(bytes, link::Name::end);
  return bytes;
}

}  // namespace whisker::golden
