# 16 KB of RAM, as on the board.
set(WHISKER_CPU cortex-m0plus)
set(WHISKER_BOARD microbit)
set(WHISKER_MAP_BYTES 8192)
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
