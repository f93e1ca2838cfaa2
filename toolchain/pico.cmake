set(WHISKER_TITLE "Raspberry Pi Pico robot")
set(WHISKER_RUNS_ON "node rp2040js")
set(WHISKER_COMPILERS "gcc")
set(WHISKER_COUNTS "-")
set(WHISKER_CPU cortex-m0plus)
set(WHISKER_BOARD pico)
# The flash has room, and a tick little time.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Options of a release")
include(${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake)
