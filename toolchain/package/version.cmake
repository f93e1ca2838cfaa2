# whisker_version: read from firmware/version.hpp. whisker_url: the home of the packages.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/url whisker_url LIMIT_COUNT 1)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../../firmware/version.hpp whisker_version
  REGEX "^#define WHISKER_VERSION_(MAJOR|MINOR|PATCH) [0-9]+$")
list(TRANSFORM whisker_version REPLACE "^.* " "")
list(JOIN whisker_version "." whisker_version)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/../../firmware/version.hpp)
