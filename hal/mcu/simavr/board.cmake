target_sources(whisker_board PRIVATE simavr/board.cpp)
