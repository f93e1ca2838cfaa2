target_sources(whisker_board PRIVATE ${emulated}/simavr/board.cpp)
