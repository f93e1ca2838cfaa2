include(${boards}/stm32f405/sources.cmake)
target_sources(whisker_board PRIVATE
  ${whisker_stm32f405_sources}
  cortex_m/aeabi_memory.cpp
  ${boards}/stm32f405/startup.cpp)
whisker_linker_script(hal/boards/stm32f405/stm32f405.ld)
