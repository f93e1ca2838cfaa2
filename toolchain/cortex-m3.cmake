set(WHISKER_CPU cortex-m3)
set(WHISKER_BOARD mps2)
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
