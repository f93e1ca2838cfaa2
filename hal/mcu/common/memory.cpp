// The functions that compilers call by themselves. Built without the optimisation that would make them call
// themselves.
#include <stddef.h>

extern "C" {

void* memcpy(void* to, const void* from, size_t count);
void* memmove(void* to, const void* from, size_t count);
void* memset(void* to, int value, size_t count);

void* memcpy(void* to, const void* from, size_t count) {
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
  auto* d = static_cast<unsigned char*>(to);
  while (count-- != 0) *d++ = static_cast<unsigned char>(value);
  return to;
}
}
