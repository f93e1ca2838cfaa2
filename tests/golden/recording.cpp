#include <fmt/core.h>

#include "tests/golden/stream.hpp"

namespace whisker::golden {

chip::Bytes recording(std::string& index) {
  std::vector<Stream> all{table_sweep()};
  for (std::vector<Stream> more : {drives(), storms()}) {
    for (Stream& stream : more) all.push_back(std::move(stream));
  }
  chip::Bytes bytes;
  chip::append(bytes, link::Name::hello);
  index.clear();
  for (const Stream& stream : all) {
    index += fmt::format("{} {}\n", bytes.size(), stream.name);
    bytes.insert(bytes.end(), stream.messages.begin(), stream.messages.end());
  }
  chip::append(bytes, link::Name::end);
  return bytes;
}

}  // namespace whisker::golden
