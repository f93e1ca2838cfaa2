set(WHISKER_CPU cortex-m0plus)
set(WHISKER_BOARD microbit)
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
