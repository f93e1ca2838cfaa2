/// The parameters on the link: raw 32-bit words in the order of for_each_param.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/apps/pil_link/bytes.hpp"
#include "firmware/params/words.hpp"

namespace whisker::link {

constexpr size_t kParamsSize = 4 * kParams;

inline void encode_params(const Params& params, uint8_t* to) noexcept {
  Encoder out{to};
  for (int i = 0; i < kParams; ++i) out.put(raw_param(params, i));
}

inline void decode_params(Params& params, const uint8_t* from) noexcept {
  Decoder in{from};
  for (int i = 0; i < kParams; ++i) {
    uint32_t raw = 0;
    in("", raw);
    set_raw_param(params, i, raw);
  }
}

}  // namespace whisker::link
