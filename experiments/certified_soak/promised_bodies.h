// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "certified_soak/random_body.h"

/// Bodies that are moved in memory, each with a promise: see Body_recipe.
namespace lodestone {

std::unique_ptr<Random_body> make_displaced(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
std::unique_ptr<Random_body> make_displaced_in_frame(const Eigen::Vector3d& centre, std::size_t frequency,
                                                     Random& random);
std::unique_ptr<Random_body> make_stretched(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
std::unique_ptr<Random_body> make_lipschitz(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
std::unique_ptr<Random_body> make_boxed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
/// Nothing is promised: read as a whole in each frame.
std::unique_ptr<Random_body> make_unbounded(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);

}  // namespace lodestone
