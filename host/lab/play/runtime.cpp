/// The module has no exceptions: a throw stops the module, and the page restarts it.
#include <cstddef>

extern "C" {
void* __cxa_allocate_exception(std::size_t) { __builtin_trap(); }
[[noreturn]] void __cxa_throw(void*, void*, void (*)(void*)) { __builtin_trap(); }
// That of the library writes a message, for which it would need imports.
[[noreturn]] void __cxa_pure_virtual() { __builtin_trap(); }
// The library's number formats name it; nothing here uses them.
__int128 __multi3(__int128, __int128) { __builtin_trap(); }
}
