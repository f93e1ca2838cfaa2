# ARM Cortex-M0+ with GNU Arm Embedded (Debian: gcc-arm-none-eabi). Builds the core as a library:
#   cmake -B build/cortex-m0plus -DCMAKE_TOOLCHAIN_FILE=toolchain/cortex-m0plus.cmake
#         -DWHISKER_HOST=OFF -DWHISKER_TESTS=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m0plus)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CXX_FLAGS_INIT
  "-mcpu=cortex-m0plus -mthumb -mfloat-abi=soft -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics \
-fno-use-cxa-atexit -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_RELEASE_INIT "-Os")
