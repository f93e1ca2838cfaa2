// The names under which clang calls memcpy and similar functions on ARM. Source: "Run-time ABI for the Arm
// Architecture", 4.3.4; its memset has another order of arguments.
#include <stddef.h>

extern "C" {

void* memcpy(void* to, const void* from, size_t count);
void* memmove(void* to, const void* from, size_t count);
void* memset(void* to, int value, size_t count);

#define WHISKER_AEABI(suffix)                                                                          \
  void __aeabi_memcpy##suffix(void* to, const void* from, size_t count) { memcpy(to, from, count); }   \
  void __aeabi_memmove##suffix(void* to, const void* from, size_t count) { memmove(to, from, count); } \
  void __aeabi_memset##suffix(void* to, size_t count, int value) { memset(to, value, count); }         \
  void __aeabi_memclr##suffix(void* to, size_t count) { memset(to, 0, count); }

WHISKER_AEABI()
WHISKER_AEABI(4)
WHISKER_AEABI(8)
}
