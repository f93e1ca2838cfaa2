# Compiles the kernel without any library for WebAssembly and for ARM, and links it: the link fails on every undefined
# symbol except memcpy and memset.
# cmake -D SOURCE_DIR=.. -D OUT=.. -D "SOURCES=a.cpp;b.cpp" -P freestanding.cmake
set(common -std=c++17 -Os -ffreestanding -ffp-contract=off -fno-math-errno -fno-exceptions -fno-rtti
  -Wall -Wextra -Werror -I${SOURCE_DIR} -c)
file(MAKE_DIRECTORY ${OUT})

set(objects "")
foreach(source IN LISTS SOURCES)
  get_filename_component(name ${source} NAME_WE)
  execute_process(
    COMMAND clang++-14 --target=wasm32 -nostdlib ${common} ${source} -o ${OUT}/${name}.wasm.o
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(
    COMMAND arm-none-eabi-g++ -mcpu=cortex-m7 -mthumb ${common} ${source} -o ${OUT}/${name}.arm.o
    COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND objects ${OUT}/${name}.wasm.o)
endforeach()

file(WRITE ${OUT}/allowed.txt "memcpy\nmemset\n")
execute_process(
  COMMAND wasm-ld-14 --no-entry --no-gc-sections --export-all --allow-undefined-file=${OUT}/allowed.txt
          ${objects} -o ${OUT}/kernel.wasm
  COMMAND_ERROR_IS_FATAL ANY)
file(SIZE ${OUT}/kernel.wasm size)
message(STATUS "kernel.wasm: ${size} bytes")
