# The libraries for other projects.
include(GNUInstallDirs)

# whisker_export(TARGET NAME): TARGET becomes whisker::NAME, here and after installation. Inside another project it is
# built only if linked, and nothing is installed.
function(whisker_export TARGET NAME)
  add_library(whisker::${NAME} ALIAS ${TARGET})
  target_compile_features(${TARGET} PUBLIC cxx_std_17)
  target_include_directories(${TARGET} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/whisker>)
  set_target_properties(${TARGET} PROPERTIES EXPORT_NAME ${NAME})
  if(whisker_top_level)
    install(TARGETS ${TARGET} EXPORT whisker ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  else()
    set_target_properties(${TARGET} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  endif()
endfunction()

# whisker_export_port(TARGET NAME FOLDER): exports a folder that is a separate library.
function(whisker_export_port TARGET NAME FOLDER)
  if(DEFINED WHISKER_BOARD)
    add_library(whisker::${NAME} ALIAS ${TARGET})
    set_target_properties(${TARGET} PROPERTIES EXCLUDE_FROM_ALL TRUE)
    return()
  endif()
  whisker_export(${TARGET} ${NAME})
  if(whisker_top_level)
    whisker_install_headers(${FOLDER})
  endif()
endfunction()

# whisker_install_headers(FOLDER): keeps the folders below include/whisker.
function(whisker_install_headers FOLDER)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${FOLDER}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/whisker/${FOLDER}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h" PATTERN apps EXCLUDE)
endfunction()

# whisker_install_package(): installs the files that find_package(whisker) reads.
function(whisker_install_package)
  include(CMakePackageConfigHelpers)
  set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/whisker)
  install(EXPORT whisker NAMESPACE whisker:: FILE whiskerTargets.cmake DESTINATION ${folder})
  configure_package_config_file(${PROJECT_SOURCE_DIR}/toolchain/package/whiskerConfig.cmake.in
    ${PROJECT_BINARY_DIR}/whiskerConfig.cmake INSTALL_DESTINATION ${folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/whiskerConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/whiskerConfig.cmake ${PROJECT_BINARY_DIR}/whiskerConfigVersion.cmake
    DESTINATION ${folder})
  whisker_install_pc()
endfunction()

# whisker_install_pc(): installs the file that pkg-config reads; it may be moved together with the libraries.
function(whisker_install_pc)
  set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  file(RELATIVE_PATH whisker_pc_to_prefix /prefix/${folder} /prefix)
  set(whisker_pc_definitions "")
  get_target_property(definitions whisker_core INTERFACE_COMPILE_DEFINITIONS)
  foreach(definition IN LISTS definitions)
    if(definition MATCHES "^WHISKER_")
      string(APPEND whisker_pc_definitions " -D${definition}")
    endif()
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/toolchain/package/whisker.pc.in ${PROJECT_BINARY_DIR}/whisker.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/whisker.pc DESTINATION ${folder})
endfunction()
