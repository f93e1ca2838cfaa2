# The AVR with room for the whole core: 128 KB of flash and 16 KB of RAM.
set(WHISKER_CPU atmega1284p)
set(WHISKER_BOARD simavr)
include(${CMAKE_CURRENT_LIST_DIR}/avr.cmake)
