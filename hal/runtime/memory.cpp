// The functions that compilers call implicitly. Built without the optimisation that would make them call
// themselves.
#include <stddef.h>
#include <stdint.h>

extern "C" {

void* memcpy(void* to, const void* from, size_t count);
void* memmove(void* to, const void* from, size_t count);
void* memset(void* to, int value, size_t count);

// Nearly all copies and fills are of whole words.
using Word [[gnu::may_alias]] = uint32_t;
constexpr bool kByWords = sizeof(void*) >= sizeof(Word);

void* memcpy(void* to, const void* from, size_t count) {
  if (kByWords &&
      (reinterpret_cast<uintptr_t>(to) | reinterpret_cast<uintptr_t>(from) | count) % sizeof(Word) == 0) {
    auto* d = static_cast<Word*>(to);
    const auto* s = static_cast<const Word*>(from);
    for (; count != 0; count -= sizeof(Word)) *d++ = *s++;
    return to;
  }
  auto* d = static_cast<unsigned char*>(to);
  const auto* s = static_cast<const unsigned char*>(from);
  while (count-- != 0) *d++ = *s++;
  return to;
}

void* memmove(void* to, const void* from, size_t count) {
  auto* d = static_cast<unsigned char*>(to);
  const auto* s = static_cast<const unsigned char*>(from);
  if (d <= s) return memcpy(to, from, count);
  while (count-- != 0) d[count] = s[count];
  return to;
}

void* memset(void* to, int value, size_t count) {
  if (kByWords && (reinterpret_cast<uintptr_t>(to) | count) % sizeof(Word) == 0) {
    const Word word = static_cast<unsigned char>(value) * UINT32_C(0x01010101);
    auto* d = static_cast<Word*>(to);
    for (; count != 0; count -= sizeof(Word)) *d++ = word;
    return to;
  }
  auto* d = static_cast<unsigned char*>(to);
  while (count-- != 0) *d++ = static_cast<unsigned char>(value);
  return to;
}
}
