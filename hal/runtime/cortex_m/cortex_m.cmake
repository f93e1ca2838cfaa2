target_sources(whisker_board PRIVATE
  ${emulated}/common/semihosting.cpp
  cortex_m/aeabi_memory.cpp
  ${emulated}/common/semihost_call_arm.cpp
  cortex_m/startup.cpp)
