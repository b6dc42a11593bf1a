// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lodestone {

/// Revision of the source that the program was built from, as `git describe` names it; `unknown` outside a clone.
const char* source_revision();

}  // namespace lodestone
