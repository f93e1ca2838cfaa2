# The whole repository as a component of ESP-IDF (docs/porting.md): the component manager copies no more than a component's folder.
get_filename_component(whisker_root ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
file(GLOB_RECURSE whisker_sources ${whisker_root}/firmware/*.cpp ${whisker_root}/hal/boards/common/*.cpp)
list(FILTER whisker_sources EXCLUDE REGEX "/firmware/apps/")

idf_component_register(SRCS ${whisker_sources} INCLUDE_DIRS ${whisker_root} KCONFIG ${CMAKE_CURRENT_LIST_DIR}/Kconfig)
target_compile_features(${COMPONENT_LIB} PUBLIC cxx_std_17)
target_compile_definitions(${COMPONENT_LIB} PUBLIC WHISKER_MAP_BYTES=${CONFIG_WHISKER_MAP_BYTES})
