target_sources(whisker_board PRIVATE ${emulated}/common/semihosting.cpp ${emulated}/virt/board.cpp ${emulated}/virt/startup.cpp)
whisker_linker_script(hal/emulated/virt/virt.ld)
# GCC treats the control registers as an extension; clang 14 does not know its name.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(whisker_board PRIVATE -march=rv32imac_zicsr)
endif()
