# Every Cortex-M. Set before: WHISKER_CPU. Debian: gcc-arm-none-eabi, plus clang-14 for clang.
set(CMAKE_SYSTEM_PROCESSOR ${WHISKER_CPU})
set(WHISKER_TRIPLE arm-none-eabi)
set(WHISKER_FLAGS "-mcpu=${WHISKER_CPU} -mthumb -mfloat-abi=soft")
set(WHISKER_CLANG_TARGET arm-none-eabi)
set(WHISKER_CLANG_FLAGS "-fshort-enums")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
