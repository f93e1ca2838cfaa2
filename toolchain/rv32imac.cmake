# RISC-V, 32 bits, with multiplication, atomics and compressed instructions. Debian: gcc-riscv64-unknown-elf, or
# clang-14 beside it.
set(WHISKER_CPU rv32imac)
set(WHISKER_BOARD virt)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
set(WHISKER_TRIPLE riscv64-unknown-elf)
set(WHISKER_FLAGS "-march=rv32imac -mabi=ilp32")
set(WHISKER_CLANG_TARGET riscv32-unknown-elf)
set(WHISKER_CLANG_FLAGS "-mno-relax")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
