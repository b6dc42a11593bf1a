// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/known_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lodestone/bounds/placed_bound.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// Where the vertices are, as the mesh or the caller says.
class Object_positions final : public Position_source {
 public:
  explicit Object_positions(Placed_mesh& mesh) : mesh_(&mesh) {}

  std::uint32_t vertex_count() const override { return mesh_->mesh().vertex_count(); }
  std::uint64_t pose_number() const override { return mesh_->pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return mesh_->read(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    mesh_->read(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { std::ranges::copy(mesh_->read(), coordinates.begin()); }
  Coordinates in_memory() const override { return mesh_->in_memory() ? mesh_->read() : Coordinates(); }
  Coordinates all(std::span<double> /*memory*/) const override { return mesh_->read(); }

 private:
  Placed_mesh* mesh_;
};

/// Where the vertices are in the mesh.
class Mesh_positions final : public Position_source {
 public:
  explicit Mesh_positions(const Placed_mesh& mesh) : mesh_(&mesh) {}

  std::uint32_t vertex_count() const override { return mesh_->mesh().vertex_count(); }
  std::uint64_t pose_number() const override { return mesh_->mesh().pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return mesh_->mesh().read(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    mesh_->mesh().read(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override {
    std::ranges::copy(mesh_->mesh().read(), coordinates.begin());
  }
  Coordinates in_memory() const override { return mesh_->mesh().in_memory() ? mesh_->mesh().read() : Coordinates(); }

 private:
  const Placed_mesh* mesh_;
};

std::vector<double> all_of(const Position_source& positions) {
  std::vector<double> coordinates(3 * std::size_t{positions.vertex_count()});
  positions.pose_all(coordinates);
  return coordinates;
}

/// Shows a bound where the vertices are in the mesh. As long as others are given, nobody else does.
void show_mesh(Node_bound& bound, const Placed_mesh& mesh, const Tree_layout& layout) {
  const Coordinates in_mesh = mesh.mesh().read();
  for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf) {
    Aabb box;
    box.enclose(layout.leaf_faces(leaf, in_mesh));
    bound.note_read(leaf, box, in_mesh);
  }
}

/// What is known of the mesh is known of the object, wherever it is placed.
std::unique_ptr<Node_bound> placed(std::unique_ptr<Node_bound> bound, const Placed_mesh& mesh,
                                   const Bounded_object& in_mesh) {
  if (mesh.given() && bound->watches()) show_mesh(*bound, mesh, in_mesh.layout);
  return std::make_unique<Placed_bound>(std::move(bound), mesh.placement(), mesh.given(), in_mesh);
}

}  // namespace

std::unique_ptr<const Position_source> positions_of(Placed_mesh& mesh) {
  return std::make_unique<Object_positions>(mesh);
}

std::vector<std::unique_ptr<Node_bound>> Known_motion::bounds(Placed_mesh& mesh, const Tree_layout& layout,
                                                              std::span<const Region_index> labels) {
  positions_in_mesh_ = std::make_unique<Mesh_positions>(mesh);
  if (promises_await_rest()) rest_ = all_of(*positions_in_mesh_);
  const Bounded_object in_mesh{.layout = layout, .labels = labels, .rest = rest_, .positions = *positions_in_mesh_};
  std::vector<std::unique_ptr<Node_bound>> bounds;
  if (auto own = bound_of_points(mesh, in_mesh)) bounds.push_back(std::move(own));
  for (std::size_t promise = 0; promise < promises_.size(); ++promise)
    bounds.push_back(promised_bound(promise, mesh, in_mesh));
  return bounds;
}

void Known_motion::take_rest(const Placed_mesh& mesh) {
  if (!awaits_rest(mesh.mesh())) return;
  auto now = all_of(Mesh_positions(mesh));
  if (!std::ranges::all_of(now, [](double coordinate) { return std::isfinite(coordinate); })) return;
  if (points_await_rest(mesh.mesh())) rest_of_points_ = now;
  if (promises_await_rest()) rest_ = std::move(now);
}

/// The bound that the points of the mesh have by themselves; null: none.
std::unique_ptr<Node_bound> Known_motion::bound_of_points(const Placed_mesh& mesh, const Bounded_object& in_mesh) {
  if (points_await_rest(mesh.mesh())) rest_of_points_ = all_of(*positions_in_mesh_);
  auto bound = mesh.mesh().own_bound({in_mesh.layout, in_mesh.labels, rest_of_points_, in_mesh.positions});
  return bound ? placed(std::move(bound), mesh, in_mesh) : nullptr;
}

/// A promise that does not fit is forgotten: it would stand in the way of every query to come. If it was the only one,
/// the next one has another rest.
std::unique_ptr<Node_bound> Known_motion::promised_bound(std::size_t promise, const Placed_mesh& mesh,
                                                         const Bounded_object& in_mesh) {
  std::unique_ptr<Node_bound> bound;
  try {
    bound = promises_[promise](in_mesh);
    if (bound->node_count() < in_mesh.layout.node_count())
      throw Bad_argument("its bound was made for a tree of fewer nodes");
  } catch (const Bad_argument& misfit) {
    promises_.erase(promises_.begin() + static_cast<std::ptrdiff_t>(promise));
    if (promises_.empty()) rest_.clear();
    throw Bad_argument("a promise about " + mesh.title() + " is dropped: " + misfit.what());
  }
  return placed(std::move(bound), mesh, in_mesh);
}

}  // namespace lodestone
