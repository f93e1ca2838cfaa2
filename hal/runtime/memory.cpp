// The functions that compilers call implicitly. Built without the optimisation that would make them call
// themselves.
#include <stddef.h>
#include <stdint.h>

extern "C" {

void* memcpy(void* to, const void* from, size_t count);
void* memmove(void* to, const void* from, size_t count);
void* memset(void* to, int value, size_t count);

// Nearly all copies and fills begin at a word, and most are of whole words.
using Word [[gnu::may_alias]] = uint32_t;
constexpr bool kByWords = sizeof(void*) >= sizeof(Word);
constexpr size_t kAtOnce = 8 * sizeof(Word);

static bool is_word(const void* at) {
  return kByWords && reinterpret_cast<uintptr_t>(at) % sizeof(Word) == 0;
}

void* memcpy(void* to, const void* from, size_t count) {
  auto* d = static_cast<unsigned char*>(to);
  const auto* s = static_cast<const unsigned char*>(from);
  if (is_word(d) && is_word(s)) {
    auto* words = reinterpret_cast<Word*>(d);
    const auto* source = reinterpret_cast<const Word*>(s);
    for (; count >= sizeof(Word); count -= sizeof(Word)) *words++ = *source++;
    d = reinterpret_cast<unsigned char*>(words);
    s = reinterpret_cast<const unsigned char*>(source);
  }
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
  auto* d = static_cast<unsigned char*>(to);
  if (is_word(d)) {
    const Word word = static_cast<unsigned char>(value) * UINT32_C(0x01010101);
    auto* words = reinterpret_cast<Word*>(d);
    for (; count >= kAtOnce; count -= kAtOnce, words += 8) {
      words[0] = words[1] = words[2] = words[3] = word;
      words[4] = words[5] = words[6] = words[7] = word;
    }
    for (; count >= sizeof(Word); count -= sizeof(Word)) *words++ = word;
    d = reinterpret_cast<unsigned char*>(words);
  }
  while (count-- != 0) *d++ = static_cast<unsigned char>(value);
  return to;
}
}
