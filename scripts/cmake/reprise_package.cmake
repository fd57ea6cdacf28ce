# Installs what a project needs to find_package(reprise). Included after every library has been declared.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/reprise)
get_property(REPRISE_COMPONENTS GLOBAL PROPERTY REPRISE_COMPONENTS)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/reprise-config.cmake.in ${PROJECT_BINARY_DIR}/reprise-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/reprise-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/reprise-config.cmake ${PROJECT_BINARY_DIR}/reprise-config-version.cmake
  DESTINATION ${package_folder})
install(EXPORT reprise_targets NAMESPACE reprise:: FILE reprise-targets.cmake DESTINATION ${package_folder})
