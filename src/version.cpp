// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/version.h"

namespace lodestone {

std::string_view version() { return LODESTONE_VERSION_TEXT; }

}  // namespace lodestone
