# SPDX-License-Identifier: GPL-3.0-or-later
# Configures a shared library, and reads what its package asks users to find and to link.
# Variables: SOURCE, BINARY, GENERATOR
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G ${GENERATOR} -D BUILD_SHARED_LIBS=ON
          -D LODESTONE_BUILD_TESTS=OFF -D LODESTONE_BUILD_PROGRAM=OFF
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE targets ${BINARY}/CMakeFiles/Export/*/lodestoneTargets.cmake)
file(STRINGS "${targets}" linked REGEX "INTERFACE_LINK_LIBRARIES")
if(NOT linked MATCHES "TBB::tbb")
  message(FATAL_ERROR "no line of libraries in ${targets}")
endif()
foreach(hidden METIS hwy TinyGLTF ZLIB fmt nlohmann)
  if(linked MATCHES ${hidden})
    message(FATAL_ERROR "users would link ${hidden}: ${linked}")
  endif()
endforeach()
