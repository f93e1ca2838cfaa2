# The Debian package of the command, the libraries and their headers: cpack --config build/demo/CPackConfig.cmake
set(whisker_doc ${CMAKE_INSTALL_DATAROOTDIR}/doc/whisker)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${whisker_doc} RENAME copyright)
install(FILES ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${whisker_doc})
install(FILES ${PROJECT_SOURCE_DIR}/docs/example/main.cpp DESTINATION ${whisker_doc}/examples)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/integration/c/ DESTINATION ${whisker_doc}/examples)
set(whisker_manual ${PROJECT_SOURCE_DIR}/toolchain/package/manual)
install(FILES ${whisker_manual}/whisker.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${whisker_manual}/whisker.bash DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions RENAME whisker
  COMPONENT command)
install(FILES ${whisker_manual}/_whisker DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/zsh/vendor-completions COMPONENT command)
install(FILES ${whisker_manual}/whisker.fish DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d COMPONENT command)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/host/robots ${PROJECT_SOURCE_DIR}/host/worlds/scenarios
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/whisker FILES_MATCHING PATTERN "*.toml")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME whisker)
set(CPACK_PACKAGE_VENDOR "The Whisker maintainers")
set(CPACK_PACKAGE_CONTACT "The Whisker maintainers <whisker@example.org>")
set(CPACK_PACKAGE_HOMEPAGE_URL ${whisker_url})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "goal navigation for small robots with three rangefinders")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "The command whisker simulates differential-drive robots with three rangefinders, puts them on a CAN bus,
and checks their parameters. The static libraries and headers are its navigation core for your firmware: C++17 and C99,
fixed point, no heap, no dependencies.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL OFF)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
include(CPack)
