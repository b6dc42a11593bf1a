// SPDX-License-Identifier: GPL-3.0-or-later
// A detector in any mode, compared with exhaustive exact checking.
#include "fuzz/detector_play.h"

LODESTONE_FUZZ_TARGET(detector) {
  lodestone::fuzz::Byte_source bytes(input);
  const auto options = lodestone::fuzz::draw_options(bytes);
  lodestone::fuzz::Detector_play(options).run(bytes);
}
