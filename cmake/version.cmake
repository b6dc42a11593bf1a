# SPDX-License-Identifier: GPL-3.0-or-later
# Sets `lodestone_version` to the version that include/lodestone/version.h tells.
set(version_header ${CMAKE_CURRENT_SOURCE_DIR}/include/lodestone/version.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${version_header})
file(STRINGS ${version_header} numbers REGEX "^#define LODESTONE_VERSION_(MAJOR|MINOR|PATCH) [0-9]+$")
list(TRANSFORM numbers REPLACE "^.* " "")
list(JOIN numbers . lodestone_version)
