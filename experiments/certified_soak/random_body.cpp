// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/random_body.h"

#include <array>

#include "certified_soak/computed_bodies.h"
#include "certified_soak/promised_bodies.h"

namespace lodestone {

std::span<const Body_recipe> body_recipes() {
  static constexpr auto recipes = std::to_array<Body_recipe>({
      {"skinned", make_skinned},
      {"morphed", make_morphed},
      {"morphed, then skinned", make_morphed_and_skinned},
      {"built-in deformations", make_deformed},
      {"displacement", make_displaced},
      {"displacement in a rigid frame", make_displaced_in_frame},
      {"stretch", make_stretched},
      {"Lipschitz", make_lipschitz},
      {"box", make_boxed},
  });
  return recipes;
}

}  // namespace lodestone
