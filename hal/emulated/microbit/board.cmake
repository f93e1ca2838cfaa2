include(cortex_m/cortex_m.cmake)
target_sources(whisker_board PRIVATE ${emulated}/microbit/board.cpp)
whisker_linker_script(hal/emulated/microbit/microbit.ld)
