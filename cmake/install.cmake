# SPDX-License-Identifier: GPL-3.0-or-later
# Installs headers, library and program, and the package for find_package(lodestone).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS lodestone EXPORT lodestone_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/lodestone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(LODESTONE_BUILD_PROGRAM)
  file(RELATIVE_PATH from_programs_to_library ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(lodestone_program PROPERTIES INSTALL_RPATH "$ORIGIN/${from_programs_to_library}")
  install(TARGETS lodestone_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lodestone)
install(EXPORT lodestone_targets FILE lodestoneTargets.cmake NAMESPACE lodestone:: DESTINATION ${package_folder})
get_target_property(library_type lodestone TYPE)
configure_package_config_file(cmake/lodestoneConfig.cmake.in lodestoneConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(lodestoneConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lodestoneConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/lodestoneConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/precompile.cmake
        DESTINATION ${package_folder})
