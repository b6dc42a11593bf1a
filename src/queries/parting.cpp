// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/parting.h"

#include <Eigen/Dense>
#include <limits>

#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/contact_patches.h"
#include "lodestone/queries/surface_triangle.h"
#include "queries/clearance_search.h"

namespace lodestone {

namespace {

/// The normal of all contacts together, then those of the contact patches.
std::vector<Eigen::Vector3d> contact_normals(const Object_surface& a, const Object_surface& b,
                                             std::span<const Face_pair> contacts) {
  std::vector<Triangle_pair> faces;
  for (const Face_pair contact : contacts)
    faces.push_back({surface_triangle(a, contact.a), surface_triangle(b, contact.b)});
  std::vector<Intersection_points> points;
  std::vector<Contact_normal> normals;
  append_intersections(faces, points);
  append_contact_normals(faces, normals);
  std::vector<Eigen::Vector3d> directions{Eigen::Vector3d::Zero()};
  for (const Contact_patch& patch : contact_patches(a, b, {contacts, points, normals}, 0)) {
    directions.front() += static_cast<double>(patch.contacts.size()) * patch.normal;
    directions.push_back(patch.normal);
  }
  return directions;
}

/// The shortest way found so far.
class Best_way {
 public:
  explicit Best_way(Clearance_search& search) : search_(search) {}

  /// @return whether it is shorter
  bool try_along(const Eigen::Vector3d& vector) {
    const Eigen::Vector3d direction = vector.stableNormalized();
    if (!(direction.norm() > 0.5)) return false;  // zero, or not finite
    const auto clearance = search_(direction, clearance_.length);
    if (!clearance) return false;
    direction_ = direction;
    clearance_ = *clearance;
    return true;
  }
  void try_both_ways(const Eigen::Vector3d& vector) {
    try_along(vector);
    try_along(-vector);
  }

  /// Goes on to the normal of the plane in which the two touch last. The planes of convex bodies bound them, so there
  /// each step is shorter.
  void follow_normals() {
    for (int step = 0; step < 8 && try_along(clearance_.normal); ++step) {
    }
  }
  /// Turns to directions beside it, by ever smaller angles.
  void turn() {
    for (double angle = 0.4; angle > 0.02; angle /= 2)
      for (int turns = 0; turns < 4 && turn_by(angle); ++turns) follow_normals();
  }

  Parting parting() const {
    const Eigen::Vector3d translation = search_.unscaled(clearance_.length * direction_);
    return {.translation = translation, .length = translation.stableNorm()};
  }

 private:
  bool turn_by(double angle) {
    const Eigen::Vector3d from = direction_, u = from.unitOrthogonal(), v = from.cross(u);
    bool shorter = false;
    for (const Eigen::Vector3d& side : {u, v, Eigen::Vector3d(-u), Eigen::Vector3d(-v)})
      shorter |= try_along(from + angle * side);
    return shorter;
  }

  Clearance_search& search_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  Clearance clearance_{.length = std::numeric_limits<double>::infinity()};
};

void try_axes_and_diagonals(Best_way& best) {
  for (int axis = 0; axis < 3; ++axis) best.try_both_ways(Eigen::Vector3d::Unit(axis));
  for (const double y : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) best.try_both_ways({1, y, z});
}

}  // namespace

Parting parting(const Object_surface& surface_a, const Layout_view& a, const Object_surface& surface_b,
                const Layout_view& b, std::span<const Face_pair> contacts) {
  Clearance_search search(a, b);
  Best_way best(search);
  for (const Eigen::Vector3d& normal : contact_normals(surface_a, surface_b, contacts)) best.try_both_ways(normal);
  best.try_both_ways(search.centre_difference());
  if (contacts.empty()) best.try_both_ways(closest_faces(a, b).points.direction);
  try_axes_and_diagonals(best);
  best.follow_normals();
  best.turn();
  return best.parting();
}

}  // namespace lodestone
