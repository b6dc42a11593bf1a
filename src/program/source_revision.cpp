// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/source_revision.h"

#include "revision.h"

namespace lodestone {

const char* source_revision() { return revision_of_source; }

}  // namespace lodestone
