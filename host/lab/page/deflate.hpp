#pragma once

#include <string>
#include <string_view>

namespace whisker::page {

/// For DecompressionStream("deflate") of browsers: zlib format, RFC 1950.
std::string deflated(std::string_view bytes);

}  // namespace whisker::page
