#include "host/hil/error_names.hpp"

#include "firmware/can/value_names.hpp"

namespace whisker::hil {

std::string error_names(std::uint16_t errors) {
  std::string words;
  for (int bit = 0; bit < 16; ++bit) {
    if ((errors >> bit & 1) == 0) continue;
    const char* const word = can::word_in<can::kErrorWords>(bit);
    words += (words.empty() ? "" : ", ") + std::string(word != nullptr ? word : "unknown");
  }
  return words;
}

}  // namespace whisker::hil
