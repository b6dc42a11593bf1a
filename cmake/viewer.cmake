# SPDX-License-Identifier: GPL-3.0-or-later
# Sets `viewer` to the template of the program's pages, or `no_viewer` to the reason why there is none.
set(LODESTONE_VIEWER "" CACHE FILEPATH "Template of pages that was built before; empty: built here from web/")
option(LODESTONE_BUILD_VIEWER "Build the template of pages; without one the program writes no pages" ON)
find_program(LODESTONE_NODE NAMES node nodejs)
find_program(LODESTONE_NPM npm)

set(viewer "")
set(no_viewer "")
set(missing "")
if(NOT LODESTONE_NODE)
  list(APPEND missing node)
endif()
if(NOT LODESTONE_NPM)
  list(APPEND missing npm)
endif()
list(JOIN missing " and " missing)

if(LODESTONE_VIEWER)
  set(viewer ${LODESTONE_VIEWER})
elseif(NOT LODESTONE_BUILD_VIEWER)
  set(no_viewer "LODESTONE_BUILD_VIEWER was off")
elseif(missing)
  set(no_viewer "${missing} could not be found: install what is missing, then configure and build again")
elseif(NOT EXISTS ${PROJECT_SOURCE_DIR}/scripts/build_viewer)
  set(no_viewer "the source has no scripts/build_viewer")
else()
  set(viewer ${PROJECT_BINARY_DIR}/viewer.html)
  # All files that the script may read, except node_modules: it is slow to scan, and changes only with the lock file.
  set(web ${PROJECT_SOURCE_DIR}/web)
  file(GLOB viewer_sources CONFIGURE_DEPENDS ${web}/*.mjs ${web}/*.json)
  file(GLOB folders CONFIGURE_DEPENDS LIST_DIRECTORIES true ${web}/*)
  foreach(folder ${folders})
    if(IS_DIRECTORY ${folder} AND NOT folder MATCHES "/(node_modules|test)$")
      file(GLOB_RECURSE files CONFIGURE_DEPENDS ${folder}/*)
      list(APPEND viewer_sources ${files})
    endif()
  endforeach()
  add_custom_command(OUTPUT ${viewer}
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/build_viewer ${viewer} ||
            (${CMAKE_COMMAND} -E echo "The viewer cannot be built: see above. -D LODESTONE_BUILD_VIEWER=OFF leaves it out." && false)
    DEPENDS ${viewer_sources} ${PROJECT_SOURCE_DIR}/scripts/build_viewer ${PROJECT_SOURCE_DIR}/scripts/install_web
    COMMENT "Building the template of pages")
  # A separate target, so that the command need not wait for the library.
  add_custom_target(lodestone_viewer DEPENDS ${viewer})
endif()
if(no_viewer)
  message(STATUS "Without the viewer: ${no_viewer}")
endif()
