// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

// Version of these headers. CMake reads it from here.
/// Grows with changes that break users; see CONTRIBUTING.md.
#define LODESTONE_VERSION_MAJOR 0
/// Grows with additions; before 1.0.0 also with changes that break users.
#define LODESTONE_VERSION_MINOR 1
/// Grows with corrections.
#define LODESTONE_VERSION_PATCH 0

/// A number that grows with the version: 10203 for 1.2.3. Write `#if LODESTONE_VERSION >= 10203`.
#define LODESTONE_VERSION (LODESTONE_VERSION_MAJOR * 10000 + LODESTONE_VERSION_MINOR * 100 + LODESTONE_VERSION_PATCH)

/// @cond  helpers
#define LODESTONE_VERSION_TEXT_OF(major, minor, patch) #major "." #minor "." #patch
#define LODESTONE_VERSION_TEXT_EXPANDED(major, minor, patch) LODESTONE_VERSION_TEXT_OF(major, minor, patch)
/// @endcond
/// Such as "1.2.3".
#define LODESTONE_VERSION_TEXT \
  LODESTONE_VERSION_TEXT_EXPANDED(LODESTONE_VERSION_MAJOR, LODESTONE_VERSION_MINOR, LODESTONE_VERSION_PATCH)

namespace lodestone {

/// Version of the library that the program runs with, such as "1.2.3". A shared library can be another one than
/// that of the headers, LODESTONE_VERSION_TEXT; both must agree in major and minor number.
std::string_view version();

/// Containers of the standard library cross the interface, and `_GLIBCXX_DEBUG` changes their layout. Only one of these
/// is in a library, so a program that was compiled otherwise cannot be linked with it.
#if defined(__GLIBCXX__) && defined(_GLIBCXX_DEBUG)
void compiled_with_glibcxx_debug();
#else
void compiled_without_glibcxx_debug();
#endif
/// Calls the one that fits to how the caller is compiled. Whatever makes a detector calls this.
inline void need_same_containers() {
#if defined(__GLIBCXX__) && defined(_GLIBCXX_DEBUG)
  compiled_with_glibcxx_debug();
#else
  compiled_without_glibcxx_debug();
#endif
}

}  // namespace lodestone
