// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/viewer.h"

#include "lodestone/mesh/errors.h"

// The assembler includes the file, since compilers are slow on string literals of megabytes.
#ifdef LODESTONE_VIEWER
asm(".pushsection .rodata\n"
    ".global lodestone_viewer_begin, lodestone_viewer_end\n"
    "lodestone_viewer_begin:\n"
    ".incbin \"" LODESTONE_VIEWER
    "\"\n"
    "lodestone_viewer_end:\n"
    ".popsection\n");
extern "C" const char lodestone_viewer_begin[], lodestone_viewer_end[];
#endif

namespace lodestone {

std::string_view viewer_template([[maybe_unused]] const std::filesystem::path& page) {
#ifdef LODESTONE_VIEWER
  return {lodestone_viewer_begin, lodestone_viewer_end};
#else
  throw Bad_output(page.string() + ": this program was built without the viewer, because " LODESTONE_NO_VIEWER);
#endif
}

}  // namespace lodestone
