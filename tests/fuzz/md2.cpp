// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/read_input.h"

LODESTONE_FUZZ_TARGET(md2) { lodestone::fuzz::read_as_animation(input, ".md2"); }
