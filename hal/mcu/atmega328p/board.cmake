include(atmega328p/sources.cmake)
target_sources(whisker_board PRIVATE ${whisker_atmega328p_sources})
