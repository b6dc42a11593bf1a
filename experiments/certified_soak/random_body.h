// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "certified_soak/random.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/detector.h"

namespace lodestone {

/// A closed surface that deforms at random, and tells where its vertices can be.
class Random_body {
 public:
  explicit Random_body(Surface_mesh mesh) : mesh_(std::move(mesh)) {}
  virtual ~Random_body() = default;
  Random_body(const Random_body&) = delete;
  Random_body& operator=(const Random_body&) = delete;

  const Surface_mesh& mesh() const { return mesh_; }
  /// Adds the body to a detector.
  virtual Object_id add_to(Detector<>& detector) const = 0;
  /// Promises a detector in mode `certified` what is known of the motion, unless the positions themselves tell.
  virtual void promise_to(Detector<>& /*detector*/, Object_id /*id*/) const {}
  /// Takes the next pose, around a place.
  virtual void move(const Eigen::Vector3d& place, Random& random) = 0;
  /// Where a detector must place the body.
  virtual std::optional<Eigen::Isometry3d> placement() const { return {}; }
  /// Where the vertices are, before they are placed.
  virtual const Position_source& positions() const = 0;
  /// Null if nothing is known of the motion.
  virtual std::unique_ptr<Node_bound> bound(const Bounded_object& object) const = 0;
  /// Whether what is known still holds if a tree is built in the present pose, which then counts as rest.
  virtual bool can_be_rebuilt() const { return true; }

 protected:
  Surface_mesh mesh_;
};

/// One way to move, and to say how.
struct Body_recipe {
  std::string_view name;
  /// @param centre  around which the body is at first
  std::unique_ptr<Random_body> (*make)(const Eigen::Vector3d& centre, std::size_t frequency, Random& random);
};

std::span<const Body_recipe> body_recipes();

}  // namespace lodestone
