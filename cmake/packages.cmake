# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages, one per component; scripts/package makes them. Which libraries the programs need is found by
# dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lodestone)
set(CPACK_PACKAGE_VENDOR "")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has a first line of its own
set(CPACK_PACKAGE_CONTACT "The Lodestone developers <developers@lodestone.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/package_documents.cmake)
set(CPACK_LODESTONE_SOURCE ${PROJECT_SOURCE_DIR})
set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

# A package: its component, name, section, first line, and text.
set(CPACK_COMPONENTS_ALL "")
macro(lodestone_package component name section summary text)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}")
endmacro()

lodestone_package(library liblodestone${soversion} libs "collision detection for deforming triangle meshes, library"
"Lodestone finds collisions between triangle meshes whose vertices move freely
from frame to frame: intersecting faces, self-collisions, pairs within a
distance, closest faces and containment. Its mode exact misses nothing.
.
This package contains the shared library.")

lodestone_package(development liblodestone-dev libdevel "collision detection for deforming triangle meshes, headers"
"Lodestone finds collisions between triangle meshes whose vertices move freely
from frame to frame: intersecting faces, self-collisions, pairs within a
distance, closest faces and containment. Its mode exact misses nothing.
.
This package contains headers, the static library, and the files of CMake and
pkg-config.")
set(headers_need "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.4), libtbb-dev (>= 2021), libgmp-dev, libmpfr-dev")
set(static_needs
    "libmetis-dev, libhwy-dev, libfmt-dev (>= 9), nlohmann-json3-dev (>= 3.11), zlib1g-dev, libtinygltf-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "liblodestone${soversion} (= ${PROJECT_VERSION}), ${headers_need}, ${static_needs}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

if(LODESTONE_BUILD_PROGRAM)
  lodestone_package(program lodestone science "collision detection for deforming triangle meshes, program"
"Lodestone finds collisions between triangle meshes whose vertices move freely
from frame to frame: intersecting faces, self-collisions, pairs within a
distance, closest faces and containment. Its mode exact misses nothing.
.
This package contains the program, which reads meshes, animations and scenes,
and scenes to play.")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS lodestone-experiments)

  lodestone_package(experiments lodestone-experiments science
"collision detection for deforming triangle meshes, experiments"
"Lodestone finds collisions between triangle meshes whose vertices move freely
from frame to frame.
.
This package contains the experiments that measure it: the command experiment
of the program lodestone.")
  set(CPACK_DEBIAN_EXPERIMENTS_PACKAGE_DEPENDS "lodestone (= ${PROJECT_VERSION})")
endif()

# Of what other folders install.
get_cmake_property(installed_components COMPONENTS)
if("python" IN_LIST installed_components)
  lodestone_package(python python3-lodestone python "collision detection for deforming triangle meshes, Python"
"Lodestone finds collisions between triangle meshes whose vertices move freely
from frame to frame: intersecting faces, self-collisions, pairs within a
distance, closest faces and containment. Its mode exact misses nothing.
.
This package contains the module for Python.")
  # An extension module is compiled for one minor version of Python.
  execute_process(COMMAND ${LODESTONE_PYTHON} -c "import sys; print(sys.version_info.minor)"
                  OUTPUT_VARIABLE minor OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy")
endif()

include(CPack)
