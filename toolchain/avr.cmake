# AVR with clang 14, linked by GCC's tools. Set before: WHISKER_CPU. Debian: clang-14, gcc-avr, binutils-avr, and
# avr-libc for the start-up alone: the vector table and the copy of initialised data.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR avr)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET avr)
# Not -ffreestanding, under which clang mangles main, which avr-libc's start-up calls.
# Inlined is only what is much smaller so than called: what else clang inlines for AVR it spills, and grows by half.
set(CMAKE_CXX_FLAGS_INIT "-mmcu=${WHISKER_CPU} -fno-builtin -nostdlibinc -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-use-cxa-atexit -mllvm -inline-threshold=-30 -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -DNDEBUG" CACHE STRING "Options of a release")
set(CMAKE_CXX_LINK_EXECUTABLE
  "avr-gcc -mmcu=${WHISKER_CPU} -nodefaultlibs -Wl,--gc-sections,--relax <LINK_FLAGS> <OBJECTS> -o <TARGET> \
-Wl,--start-group <LINK_LIBRARIES> -lgcc -Wl,--end-group")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .elf)
# Through assembly, in which a fault of clang is mended.
set(CMAKE_CXX_COMPILE_OBJECT
  "<CMAKE_CXX_COMPILER> <DEFINES> <INCLUDES> <FLAGS> -S <SOURCE> -o <OBJECT>.s"
  "sh ${CMAKE_CURRENT_LIST_DIR}/avr_assembly.sh <OBJECT>.s"
  "<CMAKE_CXX_COMPILER> -mmcu=${WHISKER_CPU} -c <OBJECT>.s -o <OBJECT>")
