include(${CMAKE_CURRENT_LIST_DIR}/drivers.cmake)
whisker_linker_script(hal/boards/stm32f405/stm32f405.ld)
