# SPDX-License-Identifier: GPL-3.0-or-later
# Installs libraries, headers, packages for CMake and pkg-config, the programs and their files. Components are packages
# of their own, see packages.cmake: library, development, program, experiments, python.
include(CMakePackageConfigHelpers)

# Libraries. Each has a file of targets of its own, since a user of the shared one need not have what the static one
# links.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lodestone)
function(lodestone_install_library target targets_file)
  install(TARGETS ${target} EXPORT ${target}_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT ${target}_targets FILE ${targets_file} NAMESPACE lodestone:: DESTINATION ${package_folder}
          COMPONENT development)
endfunction()
lodestone_install_library(lodestone lodestoneTargets.cmake)
if(TARGET lodestone_shared)
  lodestone_install_library(lodestone_shared lodestoneSharedTargets.cmake)
endif()
install(DIRECTORY include/lodestone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

get_target_property(library_type lodestone TYPE)
configure_package_config_file(cmake/lodestoneConfig.cmake.in lodestoneConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(lodestoneConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lodestoneConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/lodestoneConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/precompile.cmake
        DESTINATION ${package_folder} COMPONENT development)

# pkg-config. Macros and options of the compiler are those of the target. Paths are relative to the file, so that an
# installation can be moved.
set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH from_pkgconfig_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
foreach(folder LIBDIR INCLUDEDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${folder}}")
    set(pkgconfig_${folder} ${CMAKE_INSTALL_${folder}})
  else()
    set(pkgconfig_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}}")
  endif()
endforeach()
configure_file(cmake/lodestone.pc.in lodestone.pc.in @ONLY)
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/lodestone.pc INPUT ${CMAKE_CURRENT_BINARY_DIR}/lodestone.pc.in
     TARGET lodestone)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lodestone.pc DESTINATION ${pkgconfig_folder} COMPONENT development)

if(LODESTONE_BUILD_PROGRAM)
  # The programs find their files by these places below the prefix: see src/program/installed_files.h.
  set(files_folder share/lodestone)
  set(experiments_folder lib/lodestone)
  function(lodestone_install_program target folder component)
    if(BUILD_SHARED_LIBS)
      file(RELATIVE_PATH to_library ${CMAKE_INSTALL_PREFIX}/${folder} ${CMAKE_INSTALL_FULL_LIBDIR})
      set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_library}")
    endif()
    install(TARGETS ${target} RUNTIME DESTINATION ${folder} COMPONENT ${component})
  endfunction()

  lodestone_install_program(lodestone_program ${CMAKE_INSTALL_BINDIR} program)
  install(DIRECTORY data/scenes DESTINATION ${files_folder} COMPONENT program)
  get_target_property(viewer lodestone_program LODESTONE_VIEWER)
  if(viewer)
    install(FILES ${viewer} DESTINATION ${files_folder} RENAME viewer.html COMPONENT program)
  endif()

  lodestone_install_program(lodestone_experiments ${experiments_folder} experiments)
  install(DIRECTORY data/characters DESTINATION ${files_folder} COMPONENT experiments FILES_MATCHING PATTERN *.glb)
  file(GLOB plots RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS experiments/*/plots)
  foreach(folder ${plots})
    install(DIRECTORY ${folder}/ DESTINATION ${files_folder}/${folder} COMPONENT experiments
            FILES_MATCHING PATTERN *.vl.json)
  endforeach()

  include(cmake/documents.cmake)
endif()
