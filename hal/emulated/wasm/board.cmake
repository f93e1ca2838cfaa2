target_sources(whisker_board PRIVATE ${emulated}/wasm/board.cpp)
