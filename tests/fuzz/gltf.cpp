// SPDX-License-Identifier: GPL-3.0-or-later
// JSON and GLB: the reader tells them apart by the first bytes. A buffer can be the file `data.bin` beside them.
#include <string>

#include "fuzz/read_input.h"
#include "fuzz/scratch_folder.h"

LODESTONE_FUZZ_TARGET(gltf) {
  using namespace lodestone::fuzz;
  static const auto data = scratch().write("data.bin", std::string(256, '\1'));
  read_as_animation(input, ".glb");
}
