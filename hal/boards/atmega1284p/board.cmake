include(${boards}/atmega1284p/sources.cmake)
target_sources(whisker_board PRIVATE ${whisker_atmega1284p_sources})
