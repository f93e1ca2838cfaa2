target_sources(whisker_board PRIVATE
  common/semihosting.cpp
  cortex_m/aeabi_memory.cpp
  cortex_m/semihost_call.cpp
  cortex_m/startup.cpp)
