// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

namespace lodestone {

template class Particle_detection<Surface_mesh, Any_strategy, Own_points<Surface_mesh>>;
template class Exact_detection<Surface_mesh, Any_strategy, Own_points<Surface_mesh>, Aabb>;
template Own_detection make_detection<Surface_mesh, Any_strategy, Own_points<Surface_mesh>, Aabb>(const Detector_options&, Any_strategy);
template class Detector<Surface_mesh, Any_strategy>;

}  // namespace lodestone
