// SPDX-License-Identifier: GPL-3.0-or-later
#include "contract/detector_volume_contract.h"

namespace lodestone {

using Volumes_2 = Some_volumes<1, 2>::type;
INSTANTIATE_TYPED_TEST_SUITE_P(Half_2, Detector_volume_contract, Volumes_2, Volume_names);

}  // namespace lodestone
