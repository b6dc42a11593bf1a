// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

namespace lodestone {

template class Exact_objects<Aabb>;
template class Exact_pairs<Aabb>;
template class Exact_detection<Aabb>;
template std::unique_ptr<Detection> make_detection<Aabb>(const Detector_options&);
template class Typed_watched_mesh<Surface_mesh, Own_points<Surface_mesh>, Lbg>;
template class Typed_watched_mesh<Surface_mesh, Own_points<Surface_mesh>, Any_strategy>;
template class Typed_watched_mesh<Indexed_mesh, Indexed_points, Lbg>;
template class Typed_watched_mesh<Indexed_mesh, Indexed_points, Any_strategy>;
template class Detector<Lbg>;
template class Detector<Any_strategy>;

}  // namespace lodestone
