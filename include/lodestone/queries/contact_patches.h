// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/object_surface.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/triangles/contact_normal.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Contacts of two objects, or of one with itself, whose faces meet in one connected place, such as a closed curve.
struct Contact_patch {
  std::vector<std::uint32_t> contacts;               ///< ascending; indices into the list of contacts
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< mean of the places where faces meet
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector, mean of the contact normals; zero if they cancel
  double depth = 0;   ///< largest depth of its contacts, in units of the coordinates; negative if all faces are apart
  double length = 0;  ///< of the curve along which faces meet, in units of the coordinates; may be infinite
};

/// Contacts with their geometry, all three lists of one length.
struct Contact_geometry {
  std::span<const Face_pair> faces;             ///< the contacts
  std::span<const Intersection_points> points;  ///< of each: where its faces meet
  std::span<const Contact_normal> normals;      ///< of each: direction and depth
};

/// The contact patches of two surfaces, or of one with itself, in the order of their first contacts.
///
/// Two contacts with a face in common belong to one patch if their other faces share a vertex or an edge that is in
/// contact with the common face; so do all contacts that are linked in this way. Exact. If all contacts are given, the
/// patches are the connected parts of the intersection. Places where a surface touches itself link nothing.
///
/// In `point` and `normal` each contact counts by the length of the segment in which its faces meet, or by the outline
/// of the polygon. If all lengths of a patch are zero, as where faces touch in points or are only near, each contact
/// counts the same. One to two times the cost of points and normals, O(n log n) for n contacts.
///
/// @param a, b       the same object for the contacts of one surface with itself
/// @param contacts   of the current positions
/// @param tolerance  below which faces are contacts; 0: where they intersect
/// @param workers    that share the work
std::vector<Contact_patch> contact_patches(const Object_surface& a, const Object_surface& b,
                                           const Contact_geometry& contacts, double tolerance,
                                           Workers& workers = Workers::alone());

}  // namespace lodestone
