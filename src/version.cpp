// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/version.h"

namespace lodestone {

std::string_view version() { return LODESTONE_VERSION_TEXT; }

#if defined(__GLIBCXX__) && defined(_GLIBCXX_DEBUG)
void compiled_with_glibcxx_debug() {}
#else
void compiled_without_glibcxx_debug() {}
#endif

}  // namespace lodestone
