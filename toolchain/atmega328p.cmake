# 32 KB of flash and 2 KB of RAM: room for the closed form and the thesis planner.
set(WHISKER_CPU atmega328p)
set(WHISKER_BOARD atmega328p)
set(WHISKER_MAP_BYTES 0)
set(WHISKER_VECTORS 5 7 10)
include(${CMAKE_CURRENT_LIST_DIR}/avr_whole.cmake)
