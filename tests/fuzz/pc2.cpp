// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/point_cache.h"

LODESTONE_FUZZ_TARGET(pc2) { lodestone::fuzz::read_as_cache(input, ".pc2"); }
