# AVR with clang 14, linked by GCC's tools. Set before: WHISKER_CPU. Debian: clang-14, gcc-avr, binutils-avr, and
# avr-libc for its start-up only: vector table and copy of initialised data.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR avr)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET avr)
# Not -ffreestanding: clang would then mangle main, which avr-libc's start-up calls.
# Inlines only if code gets much smaller: with more inlining, clang for AVR spills registers and code grows by half.
set(CMAKE_CXX_FLAGS_INIT "-mmcu=${WHISKER_CPU} -fno-builtin -nostdlibinc -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-use-cxa-atexit -mllvm -inline-threshold=-30 -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -DNDEBUG" CACHE STRING "Options of a release")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .elf)
# Objects and libraries hold LLVM bitcode. At the link they become assembly, where a fault of clang is corrected.
set(CMAKE_CXX_COMPILE_OBJECT
  "<CMAKE_CXX_COMPILER> <DEFINES> <INCLUDES> <FLAGS> -c -emit-llvm <SOURCE> -o <OBJECT>")
set(CMAKE_CXX_LINK_EXECUTABLE
  "sh ${CMAKE_CURRENT_LIST_DIR}/avr_link.sh ${WHISKER_CPU} <TARGET> <OBJECTS> <LINK_LIBRARIES> -- \
<LINK_FLAGS>")
