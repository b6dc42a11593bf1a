// SPDX-License-Identifier: GPL-3.0-or-later
// An object whose positions are given, and how its nodes lie in their boxes.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/position_source.h"
#include "support/face_soup.h"

namespace lodestone {

/// Positions in memory, which may change at any time.
class Given_positions final : public Position_source {
 public:
  explicit Given_positions(const std::vector<double>& coordinates) : coordinates_(&coordinates) {}

  std::uint32_t vertex_count() const override { return static_cast<std::uint32_t>(coordinates_->size() / 3); }
  std::uint64_t pose_number() const override { return 0; }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override {
    return Eigen::Map<const Eigen::Vector3d>(coordinates_->data() + 3 * std::size_t{vertex});
  }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    for (const auto vertex : vertices)
      Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
  }
  void pose_all(std::span<double> coordinates) const override { std::ranges::copy(*coordinates_, coordinates.begin()); }
  Coordinates all(std::span<double> /*memory*/) const override { return *coordinates_; }
  Coordinates in_memory() const override { return reads_in_place ? Coordinates(*coordinates_) : Coordinates(); }

  bool reads_in_place = false;

 private:
  const std::vector<double>* coordinates_;
};

/// Not movable, since bounds refer to it.
struct Given_object {
  Face_soup rest;
  std::vector<double> now;
  std::vector<Region_index> labels;
  Tree_surface tree;
  const Tree_layout& layout;
  Given_positions positions;

  explicit Given_object(Face_soup soup, std::size_t leaf_faces = 12, std::vector<Region_index> regions = {})
      : rest(std::move(soup)),
        now(rest.coordinates),
        labels(std::move(regions)),
        tree(rest.faces, rest.coordinates, {.leaf_faces = leaf_faces}),
        layout(tree.tree()),
        positions(now) {}
  Given_object(const Given_object&) = delete;
  Given_object& operator=(const Given_object&) = delete;

  Bounded_object bounded() const { return {layout, labels, rest.coordinates, positions}; }
  std::uint32_t vertex_count() const { return rest.vertex_count(); }
  Eigen::Vector3d at_rest(std::uint32_t vertex) const { return at(rest.coordinates, vertex); }
  void put(std::uint32_t vertex, const Eigen::Vector3d& p) {
    Eigen::Map<Eigen::Vector3d>(now.data() + 3 * std::size_t{vertex}) = p;
  }
  /// Takes every vertex to `map(its position at rest)`.
  template <class Map>
  void pose(Map map) {
    for (std::uint32_t v = 0; v < vertex_count(); ++v) put(v, map(at_rest(v)));
  }
  Aabb fitted(std::uint32_t leaf) const {
    Aabb box;
    box.enclose(layout.leaf_faces(leaf, now));
    return box;
  }
  /// The smallest box of a node.
  Aabb fitted_node(std::uint32_t node) const {
    Aabb box = fitted(layout.node(node).leaf);
    for (auto leaf = layout.node(node).leaf; leaf < layout.node(node).end_leaf; ++leaf) box.enclose(box, fitted(leaf));
    return box;
  }
  template <class Bound>
  std::unique_ptr<Bounded_surface> surface(Bound& bound, bool in_place = false) {
    std::vector<std::unique_ptr<Node_bound>> bounds;
    bounds.push_back(std::make_unique<Node_bound_of<Bound&>>(bound));
    auto source = std::make_unique<Given_positions>(now);
    source->reads_in_place = in_place;
    return std::make_unique<Bounded_surface>(tree, std::move(source), std::move(bounds));
  }

  static Eigen::Vector3d at(const std::vector<double>& coordinates, std::uint32_t vertex) {
    return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex});
  }
};

inline bool lies_in(const Aabb& inner, const Aabb& outer) {
  bool result = true;
  for (int axis = 0; axis < 3; ++axis)
    result &= outer.low[axis] <= inner.low[axis] && inner.high[axis] <= outer.high[axis];
  return result;
}

/// How many nodes have a vertex that is not in their box. Doubles are compared, so this is exact.
template <class Bound>
std::size_t nodes_outside(const Bound& bound, const Given_object& object) {
  std::size_t count = 0;
  for (std::uint32_t node = 0; node < object.layout.node_count(); ++node)
    count += lies_in(object.fitted_node(node), bound.box(node)) ? 0 : 1;
  return count;
}

inline double random_number(std::mt19937_64& random, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Eigen::Vector3d random_direction(std::mt19937_64& random) {
  Eigen::Vector3d v;
  do v = {random_number(random), random_number(random), random_number(random)};
  while (v.norm() < 0.1 || v.norm() > 1);
  return v.normalized();
}

inline Eigen::Isometry3d random_frame(std::mt19937_64& random, double distance) {
  return Eigen::Translation3d(distance * random_direction(random)) *
         Eigen::Isometry3d(Eigen::AngleAxisd(random_number(random, -4, 4), random_direction(random)));
}

inline const Aabb open_box = [] {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return Aabb{.low = {-infinity, -infinity, -infinity, 0}, .high = {infinity, infinity, infinity, 0}};
}();

/// Each vertex of a chain in turn is off to one side, all others to the other: two errors apart, whichever is read.
template <class Promise>
void expect_inside_off_both_ways(const Promise& promise) {
  Face_soup chain;
  for (std::uint32_t v = 0; v < 40; ++v) {
    chain.coordinates.insert(chain.coordinates.end(), {static_cast<double>(v), 0, 0});
    if (v >= 2) chain.faces.push_back({v - 2, v - 1, v});
  }
  Given_object object(chain, 8);
  const auto bound = promise.bound(object.bounded());
  for (std::uint32_t other = 0; other < object.vertex_count(); ++other) {
    object.pose([](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x() + 10, 0, 0); });
    object.put(other, object.at_rest(other) - Eigen::Vector3d(10, 0, 0));
    EXPECT_EQ(nodes_outside(bound, object), 0U) << other;
  }
}

}  // namespace lodestone
