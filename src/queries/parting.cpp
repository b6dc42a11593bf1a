// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/parting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/contact_patches.h"
#include "lodestone/queries/surface_triangle.h"
#include "queries/clearance_search.h"
#include "queries/distinct_directions.h"

namespace lodestone {

namespace {

/// The normal of all contacts together, then those of the contact patches.
std::vector<Eigen::Vector3d> normals_between(const Object_surface& a, const Object_surface& b,
                                             std::span<const Face_pair> contacts, Workers& workers) {
  constexpr std::size_t per_task = 256;
  std::vector<Intersection_points> points(contacts.size());
  std::vector<Contact_normal> normals(contacts.size());
  workers.run((contacts.size() + per_task - 1) / per_task, [&](std::size_t task, std::size_t) {
    const std::size_t first = task * per_task, count = std::min(per_task, contacts.size() - first);
    std::vector<Triangle_pair> faces;
    for (const Face_pair contact : contacts.subspan(first, count))
      faces.push_back({surface_triangle(a, contact.a), surface_triangle(b, contact.b)});
    triangle_intersections(faces, std::span(points).subspan(first, count));
    contact_normals(faces, std::span(normals).subspan(first, count));
  });
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> of_patches;
  for (const Contact_patch& patch : contact_patches(a, b, {contacts, points, normals}, 0, workers)) {
    sum += static_cast<double>(patch.contacts.size()) * patch.normal;
    of_patches.push_back(patch.normal);
  }
  std::vector<Eigen::Vector3d> directions = distinct_directions(of_patches);
  directions.insert(directions.begin(), sum);
  return directions;
}

/// Searches along several directions at once: one search for each worker that takes part, each of which keeps the
/// leaves that it has read.
class Shared_search {
 public:
  Shared_search(const Layout_view& a, const Layout_view& b, Workers& workers)
      : a_(a), b_(b), workers_(workers), searches_(workers.count()) {
    of_worker(0);
  }

  const Clearance_search& any() const { return *searches_.front(); }

  /// The clearance along each of some directions, none where it is not below the limit, or not below that along an
  /// earlier direction. The last that is there is the least.
  void along(std::span<const Eigen::Vector3d> directions, double limit,
             std::vector<std::optional<Clearance>>& clearances) {
    clearances.assign(directions.size(), std::nullopt);
    Limit least(limit);
    const auto search = [&](std::size_t index, std::size_t worker) {
      clearances[index] = of_worker(worker)(directions[index], least.before(index));
      if (clearances[index]) least.lower(clearances[index]->length, index);
    };
    workers_.run(directions.size(), std::cref(search));
    for (auto& clearance : clearances) {
      if (clearance && clearance->length < limit)
        limit = clearance->length;
      else
        clearance.reset();
    }
  }

 private:
  /// The least length so far. An earlier direction may still be as long as a later one that was faster to search.
  class Limit {
   public:
    explicit Limit(double length) : length_(length) {}

    double before(std::size_t index) {
      const std::lock_guard lock(mutex_);
      return index < index_ ? std::nextafter(length_, std::numeric_limits<double>::infinity()) : length_;
    }
    void lower(double length, std::size_t index) {
      const std::lock_guard lock(mutex_);
      if (std::pair(length, index) < std::pair(length_, index_)) length_ = length, index_ = index;
    }

   private:
    std::mutex mutex_;
    double length_;
    std::size_t index_ = 0;  ///< of the direction that has it
  };

  Clearance_search& of_worker(std::size_t worker) {
    auto& search = searches_[worker];
    return search ? *search : search.emplace(a_, b_);
  }

  const Layout_view &a_, &b_;
  Workers& workers_;
  std::vector<std::optional<Clearance_search>> searches_;
};

/// The shortest way found so far.
class Best_way {
 public:
  explicit Best_way(Shared_search& search) : search_(search) {}

  /// Tries each in turn, in effect: of directions with the same length the first wins.
  /// @return whether one is shorter
  bool try_along(std::span<const Eigen::Vector3d> vectors) {
    directions_.clear();
    for (const auto& vector : vectors) {
      const Eigen::Vector3d direction = vector.stableNormalized();
      if (direction.norm() > 0.5) directions_.push_back(direction);  // otherwise zero, or not finite
    }
    search_.along(directions_, clearance_.length, found_);
    bool shorter = false;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!found_[i]) continue;
      direction_ = directions_[i];
      clearance_ = *found_[i];
      shorter = true;
    }
    return shorter;
  }

  /// Goes on to the normal of the plane in which the two touch last. The planes of convex bodies bound them, so there
  /// each step is shorter.
  void follow_normals() {
    for (int step = 0; step < 8 && try_along(std::array{clearance_.normal}); ++step) {
    }
  }
  /// Turns to directions beside it, by ever smaller angles.
  void turn() {
    for (double angle = 0.4; angle > 0.02; angle /= 2)
      for (int turns = 0; turns < 4 && turn_by(angle); ++turns) follow_normals();
  }

  Parting parting() const {
    const Eigen::Vector3d translation = search_.any().unscaled(clearance_.length * direction_);
    return {.translation = translation, .length = translation.stableNorm()};
  }

 private:
  bool turn_by(double angle) {
    const Eigen::Vector3d from = direction_, u = from.unitOrthogonal(), v = from.cross(u);
    return try_along(
        std::array<Eigen::Vector3d, 4>{from + angle * u, from + angle * v, from - angle * u, from - angle * v});
  }

  Shared_search& search_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  Clearance clearance_{.length = std::numeric_limits<double>::infinity()};
  // Memory of `try_along`.
  std::vector<Eigen::Vector3d> directions_;
  std::vector<std::optional<Clearance>> found_;
};

void add_both_ways(const Eigen::Vector3d& vector, std::vector<Eigen::Vector3d>& vectors) {
  vectors.push_back(vector);
  vectors.push_back(-vector);
}

void add_axes_and_diagonals(std::vector<Eigen::Vector3d>& vectors) {
  for (int axis = 0; axis < 3; ++axis) add_both_ways(Eigen::Vector3d::Unit(axis), vectors);
  for (const double y : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0}) add_both_ways({1, y, z}, vectors);
}

}  // namespace

Parting parting(const Object_surface& surface_a, const Layout_view& a, const Object_surface& surface_b,
                const Layout_view& b, std::span<const Face_pair> contacts, Workers& workers) {
  Shared_search search(a, b, workers);
  std::vector<Eigen::Vector3d> ways;
  for (const Eigen::Vector3d& normal : normals_between(surface_a, surface_b, contacts, workers))
    add_both_ways(normal, ways);
  add_both_ways(search.any().centre_difference(), ways);
  if (contacts.empty()) add_both_ways(closest_faces(a, b).points.direction, ways);
  add_axes_and_diagonals(ways);
  Best_way best(search);
  best.try_along(std::span(ways).first(1));  // with a length to beat, most of the others take far less
  best.try_along(std::span(ways).subspan(1));
  best.follow_normals();
  best.turn();
  return best.parting();
}

}  // namespace lodestone
