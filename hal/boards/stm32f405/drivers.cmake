# The drivers, start-up and vector table for every board with this chip. The board names its linker script, and its
# wiring if that differs.
include(${CMAKE_CURRENT_LIST_DIR}/sources.cmake)
target_sources(whisker_board PRIVATE
  ${whisker_stm32f405_sources}
  ${PROJECT_SOURCE_DIR}/hal/runtime/cortex_m/aeabi_memory.cpp
  ${CMAKE_CURRENT_LIST_DIR}/startup.cpp)
