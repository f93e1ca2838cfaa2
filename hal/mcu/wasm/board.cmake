target_sources(whisker_board PRIVATE wasm/board.cpp)
