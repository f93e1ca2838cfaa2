# WebAssembly with libc++ and the heap of wasi-libc, but without imports. Debian: clang-14, lld-14,
# libc++-14-dev-wasm32, libc++abi-14-dev-wasm32, wasi-libc.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_FLAGS_INIT "-fno-exceptions -fno-rtti -fno-threadsafe-statics -mbulk-memory -msign-ext -mnontrapping-fptoint -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_RELEASE "-Oz -flto -DNDEBUG" CACHE STRING "Options of a release")
set(CMAKE_CXX_LINK_EXECUTABLE
  "clang++-14 --target=wasm32-wasi -mexec-model=reactor -nodefaultlibs -Wl,--strip-all,-z,stack-size=65536 <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES> -lc++ -lc++abi -lc")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
