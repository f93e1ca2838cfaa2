include(cortex_m/cortex_m.cmake)
target_sources(whisker_board PRIVATE microbit/board.cpp)
whisker_linker_script(hal/mcu/microbit/microbit.ld)
