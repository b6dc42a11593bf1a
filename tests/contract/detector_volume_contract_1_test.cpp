// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract/detector_volume_contract.h"

namespace lodestone {

using Volumes_1 = Some_volumes<0, 2>::type;
INSTANTIATE_TYPED_TEST_SUITE_P(Half_1, Detector_volume_contract, Volumes_1, Volume_names);

}  // namespace lodestone
