# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the revision of the source into a header. Does not touch the header if the revision has not changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(revision MATCHES "-dirty$")  # two different changes have two names
  execute_process(COMMAND git -C ${SOURCE} diff --no-ext-diff --no-color --binary HEAD OUTPUT_VARIABLE change ERROR_QUIET)
  string(SHA1 change "${change}")
  string(SUBSTRING ${change} 0 8 change)
  string(APPEND revision "-${change}")
endif()
# An unpacked archive may lie in the repository of something else.
execute_process(COMMAND git -C ${SOURCE} rev-parse --show-prefix
                OUTPUT_VARIABLE inside OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(failed OR inside)
  set(revision "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
  "#pragma once\n\ninline constexpr const char* revision_of_source = \"@revision@\";\n")
