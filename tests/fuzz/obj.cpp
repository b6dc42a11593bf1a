// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/read_input.h"

LODESTONE_FUZZ_TARGET(obj) { lodestone::fuzz::read_as_mesh(input, ".obj"); }
