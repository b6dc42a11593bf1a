# SPDX-License-Identifier: GPL-3.0-or-later
# What Debian wants in a package beside what is installed: the copyright, the changelog, a compressed man page, and
# reasons for what its checker lintian objects to. CPack runs it on the files of all packages.
set(overrides_library
  "# CPack writes scripts that call ldconfig, and no trigger."
  lacks-ldconfig-trigger maintscript-calls-ldconfig)
set(overrides_development
  "# The headers need this option: intervals of CGAL change the rounding mode."
  pkg-config-bad-directive
  "# The folder of libraries is not that of one architecture."
  pkg-config-unavailable-for-cross-compilation)

function(compress file)
  execute_process(COMMAND gzip -9 -n -f ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
string(CONCAT changelog
  "${CPACK_PACKAGE_NAME} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
  "  * Changes are listed in CHANGELOG.md of the source.\n\n"
  " -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  if(NOT IS_DIRECTORY ${root})
    continue()
  endif()
  set(documents ${root}/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  file(COPY_FILE ${CPACK_LODESTONE_SOURCE}/cmake/copyright ${documents}/copyright)
  file(WRITE ${documents}/changelog "${changelog}")
  compress(${documents}/changelog)
  if(overrides_${component})
    list(JOIN overrides_${component} "\n" overrides)
    file(WRITE ${root}/share/lintian/overrides/${package} "${overrides}\n")
  endif()
  file(GLOB man_pages ${root}/share/man/man1/*.1)
  foreach(page ${man_pages})
    compress(${page})
  endforeach()
endforeach()
