// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

namespace lodestone {

template class Particle_object<Surface_mesh, Own_points<Surface_mesh>>;
template class Particle_detection<Surface_mesh, Lbg, Own_points<Surface_mesh>>;
template class Exact_detection<Surface_mesh, Lbg, Own_points<Surface_mesh>, Aabb>;
template Own_detection make_detection<Surface_mesh, Lbg, Own_points<Surface_mesh>, Aabb>(const Detector_options&, Lbg);
template class Detector<Surface_mesh>;

}  // namespace lodestone
