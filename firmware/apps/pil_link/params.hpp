/// The parameters as raw 32-bit values, in the order of for_each_param.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/apps/pil_link/bytes.hpp"
#include "firmware/params.hpp"

namespace whisker::link {

struct ParamCounter {
  size_t n = 0;
  template <class T>
  constexpr void number(const char*, const T&, T, T) noexcept {
    ++n;
  }
  constexpr void count(const char*, const int32_t&, int32_t, int32_t) noexcept { ++n; }
  template <class E>
  constexpr void choice(const char*, const E&, const char* const*, int) noexcept {
    ++n;
  }
};

constexpr size_t params_size() noexcept {
  const Params p{};
  ParamCounter counter;
  for_each_param(p, counter);
  return 4 * counter.n;
}

class ParamEncoder {
 public:
  explicit ParamEncoder(uint8_t* to) noexcept : out_(to) {}
  template <class T>
  void number(const char*, const T& field, T, T) noexcept {
    out_.put(static_cast<uint32_t>(field.raw()));
  }
  void count(const char*, const int32_t& field, int32_t, int32_t) noexcept { out_.put(field); }
  template <class E>
  void choice(const char*, const E& field, const char* const*, int) noexcept {
    out_.put(static_cast<uint32_t>(field));
  }

 private:
  Encoder out_;
};

class ParamDecoder {
 public:
  explicit ParamDecoder(const uint8_t* from) noexcept : in_(from) {}
  template <class T>
  void number(const char*, T& field, T, T) noexcept {
    auto raw = field.raw();
    in_("", raw);
    field = T::from_raw(raw);
  }
  void count(const char*, int32_t& field, int32_t, int32_t) noexcept { in_("", field); }
  template <class E>
  void choice(const char*, E& field, const char* const*, int) noexcept {
    uint32_t raw = 0;
    in_("", raw);
    field = static_cast<E>(raw);
  }

 private:
  Decoder in_;
};

}  // namespace whisker::link
