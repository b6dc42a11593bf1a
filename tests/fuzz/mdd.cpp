// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/point_cache.h"

LODESTONE_FUZZ_TARGET(mdd) { lodestone::fuzz::read_as_cache(input, ".mdd"); }
