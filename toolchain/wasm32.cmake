# WebAssembly without a system interface. Debian: clang-14 and lld-14.
set(WHISKER_TITLE "WebAssembly")
set(WHISKER_RUNS_ON "node")
set(WHISKER_COMPILERS "clang")
set(WHISKER_BY_DAY "clang")
set(WHISKER_COUNTS "-")
set(WHISKER_CPU wasm32)
set(WHISKER_BOARD wasm)
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32)
set(CMAKE_CXX_FLAGS_INIT "-ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -mbulk-memory \
-ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG" CACHE STRING "Options of a release")
set(CMAKE_CXX_LINK_EXECUTABLE
  "clang++-14 --target=wasm32 -nostdlib -Wl,--no-entry,-z,stack-size=8192 <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
