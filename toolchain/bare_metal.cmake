# Shared by the toolchain files of all chips: no operating system, no library, and sections that the linker can drop if
# unused. Set before: WHISKER_FLAGS, the options of the processor, and WHISKER_TRIPLE, the tools' prefix.
# WHISKER_CLANG=ON compiles with clang 14 and links with the GNU tools.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WHISKER_CLANG)
option(WHISKER_CLANG "Compile with clang 14 instead of GCC" OFF)

set(common "-ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit \
-fno-asynchronous-unwind-tables -fno-unwind-tables -ffunction-sections -fdata-sections")
if(WHISKER_CLANG)
  set(CMAKE_CXX_COMPILER clang++-14)
  set(CMAKE_CXX_COMPILER_TARGET ${WHISKER_CLANG_TARGET})
  set(CMAKE_CXX_FLAGS_INIT "${WHISKER_FLAGS} ${WHISKER_CLANG_FLAGS} ${common} -nostdlibinc")
else()
  set(CMAKE_CXX_COMPILER ${WHISKER_TRIPLE}-g++)
  # Writes each function's stack and calls into a file beside the object, for scripts/budget.
  set(CMAKE_CXX_FLAGS_INIT "${WHISKER_FLAGS} ${common} -fcallgraph-info=su")
endif()
# Not ..._INIT: CMake would append its own -O3.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG" CACHE STRING "Options of a release")

# GCC links for clang too, because it finds the compiler's helpers for this processor.
set(CMAKE_CXX_LINK_EXECUTABLE
  "${WHISKER_TRIPLE}-gcc ${WHISKER_FLAGS} -nostdlib -Wl,--gc-sections,--fatal-warnings,-z,noexecstack <LINK_FLAGS> <OBJECTS> -o <TARGET> \
-Wl,--start-group <LINK_LIBRARIES> -lgcc -Wl,--end-group")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .elf)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
