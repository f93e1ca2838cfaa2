/// Messages to bytes and back.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace whisker::link {

/// Writes integers and enumerations, little-endian.
class Encoder {
 public:
  explicit Encoder(uint8_t* to) noexcept : at_(to) {}
  template <class T>
  void operator()(const char*, T value) noexcept {
    put(value);
  }
  template <class T>
  void put(T value) noexcept {
    put(static_cast<uint64_t>(value), sizeof(T));
  }
  uint8_t* end() const noexcept { return at_; }

 private:
  void put(uint64_t bits, uint8_t bytes) noexcept {
    for (; bytes > 0; --bytes, bits >>= 8) *at_++ = static_cast<uint8_t>(bits);
  }
  uint8_t* at_;
};

class Decoder {
 public:
  explicit Decoder(const uint8_t* from) noexcept : at_(from) {}
  template <class T>
  void operator()(const char*, T& value) noexcept {
    value = static_cast<T>(get(sizeof(T)));
  }

 private:
  uint64_t get(uint8_t bytes) noexcept {
    uint64_t bits = 0;
    for (uint8_t i = 0; i < bytes; ++i) bits |= static_cast<uint64_t>(*at_++) << (8 * i);
    return bits;
  }
  const uint8_t* at_;
};

/// Counts bytes.
class Ruler {
 public:
  template <class T>
  constexpr void operator()(const char*, const T&) noexcept {
    size_ += sizeof(T);
  }
  constexpr size_t size() const noexcept { return size_; }

 private:
  size_t size_ = 0;
};

/// The bytes of a message's body.
template <class M>
constexpr size_t size_of() noexcept {
  constexpr size_t kSize = [] {
    Ruler ruler;
    const M m{};
    M::each(m, ruler);
    return ruler.size();
  }();
  return kSize;
}

/// `to` has room for size_of<M>() bytes. Returns their end.
template <class M>
uint8_t* encode(const M& m, uint8_t* to) noexcept {
  Encoder encoder{to};
  M::each(m, encoder);
  return encoder.end();
}

template <class M>
M decode(const uint8_t* from) noexcept {
  M m{};
  Decoder decoder{from};
  M::each(m, decoder);
  return m;
}

}  // namespace whisker::link
