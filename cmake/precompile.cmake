# SPDX-License-Identifier: GPL-3.0-or-later
# For users with several files that include <lodestone/detector.h>: compiles it, and CGAL's headers with it, once per
# target. The target links lodestone::lodestone.
function(lodestone_precompile_headers target)
  target_precompile_headers(${target} PRIVATE <lodestone/detector.h>)
endfunction()
