# `cmake --install` puts the static library, the public headers and a package configuration where another project finds
# them by `find_package(reflines)`.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(REFLINES_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/reflines)

install(TARGETS reflines EXPORT reflines ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT reflines)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/native/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT reflines)
install(EXPORT reflines NAMESPACE reflines:: FILE reflines-targets.cmake DESTINATION ${REFLINES_PACKAGE_FOLDER}
  COMPONENT reflines)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/reflines-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/reflines-config.cmake ${CMAKE_CURRENT_LIST_DIR}/reflines-dependencies.cmake
  ${PROJECT_BINARY_DIR}/reflines-config-version.cmake DESTINATION ${REFLINES_PACKAGE_FOLDER} COMPONENT reflines)
