# What the ATmega328P's image is built with, on a chip with room to replay the golden streams.
set(WHISKER_CPU atmega1284p)
set(WHISKER_BOARD simavr)
set(WHISKER_VECTORS)
set(WHISKER_MAP_BYTES 0)
include(${CMAKE_CURRENT_LIST_DIR}/avr_whole.cmake)
