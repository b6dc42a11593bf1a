// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "certified_soak/random_body.h"

/// Bodies whose positions are computed: see Body_recipe.
namespace lodestone {

std::unique_ptr<Random_body> make_skinned(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
std::unique_ptr<Random_body> make_morphed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
std::unique_ptr<Random_body> make_morphed_and_skinned(const Eigen::Vector3d& centre, std::size_t frequency,
                                                      Random& random);
std::unique_ptr<Random_body> make_deformed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);

}  // namespace lodestone
