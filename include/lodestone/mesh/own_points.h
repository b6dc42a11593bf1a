// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/boost/graph/properties.h>

namespace lodestone {

/// The vertex point map that a mesh has of its own.
template <class Mesh>
using Own_points = typename boost::property_map<Mesh, CGAL::vertex_point_t>::const_type;

}  // namespace lodestone
