# The AVR with room for the whole core but the map: 128 KB of flash and 16 KB of RAM.
set(WHISKER_CPU atmega1284p)
set(WHISKER_BOARD simavr)
set(WHISKER_MAP_BYTES 0)
include(${CMAKE_CURRENT_LIST_DIR}/avr.cmake)
