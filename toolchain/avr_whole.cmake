# AVR with clang 14, every image optimised as a whole: a third smaller, for the chips with little flash. Objects are
# LLVM's bitcode; interrupts stay visible by their numbers in the chip's vector table. Set before: WHISKER_CPU,
# WHISKER_VECTORS. Debian: llvm-14 beside what avr.cmake needs.
include(${CMAKE_CURRENT_LIST_DIR}/avr.cmake)
unset(CMAKE_CXX_COMPILE_OBJECT)
# Inlined is only what is smaller so than called: first within a file, then among all. Functions with the same code
# become one.
set(inline -inline-threshold=-20)
set(inline_all -inline-threshold=-30)
set(CMAKE_CXX_FLAGS_INIT "-mmcu=${WHISKER_CPU} -flto -mllvm ${inline} -fno-builtin -nostdlibinc -fno-exceptions -fno-rtti \
-fno-threadsafe-statics -fno-use-cxa-atexit -ffunction-sections -fdata-sections")
set(kept main,exit,memcpy,memmove,memset)
foreach(vector ${WHISKER_VECTORS})
  string(APPEND kept ",__vector_${vector}")
endforeach()
set(CMAKE_CXX_LINK_EXECUTABLE
  "llvm-link-14 <OBJECTS> <LINK_LIBRARIES> -o <TARGET>.all.bc"
  "opt-14 --internalize-public-api-list=${kept} ${inline_all} -passes=internalize,globaldce,mergefunc <TARGET>.all.bc \
-o <TARGET>.bc"
  "clang++-14 --target=avr -mmcu=${WHISKER_CPU} -Oz -mllvm ${inline_all} -ffunction-sections -fdata-sections -x ir \
-S <TARGET>.bc -o <TARGET>.s"
  "sh ${CMAKE_CURRENT_LIST_DIR}/avr_assembly.sh <TARGET>.s"
  "clang++-14 --target=avr -mmcu=${WHISKER_CPU} -c <TARGET>.s -o <TARGET>.o"
  "avr-gcc -mmcu=${WHISKER_CPU} -nodefaultlibs -Wl,--gc-sections,--relax <LINK_FLAGS> <TARGET>.o -o <TARGET> -lgcc")
