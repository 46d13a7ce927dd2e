# The installed tree: the program, the core, the headers of base, mesh and interfaces, the plugins (each by its own
# CMakeLists.txt) and what find_package(Breakwater) reads.
include(CMakePackageConfigHelpers)

install(TARGETS breakwater RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS breakwater_core EXPORT BreakwaterTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(room base mesh interfaces)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/breakwater/${room}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/breakwater FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/include/breakwater/base/abi.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/breakwater/base)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Breakwater)
install(EXPORT BreakwaterTargets NAMESPACE Breakwater:: DESTINATION ${config_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/BreakwaterConfig.cmake.in
  ${PROJECT_BINARY_DIR}/BreakwaterConfig.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/BreakwaterConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/BreakwaterConfig.cmake ${PROJECT_BINARY_DIR}/BreakwaterConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/BreakwaterAddPlugin.cmake DESTINATION ${config_folder})
