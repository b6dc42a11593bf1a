// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/placed_mesh.h"

#include <algorithm>
#include <utility>

#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/joined_vertices.h"

namespace lodestone {

std::vector<std::uint32_t> changed_faces(std::span<const Corners> former, std::span<const Corners> now) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t face = 0; face < now.size(); ++face)
    if (face >= former.size() || former[face] != now[face]) changed.push_back(face);
  return changed;
}

Placed_mesh::Faces::Faces(std::unique_ptr<Watched_mesh> watched, std::span<const std::uint32_t> file_vertex)
    : mesh(std::move(watched)), joined(join_vertices(mesh->corners(), mesh->vertex_count(), file_vertex)) {}

std::vector<std::uint32_t> Placed_mesh::renumber(std::span<const std::uint32_t> file_vertex, Workers& workers) {
  return replace(Faces(mesh().renumbered(workers), file_vertex));
}

std::vector<std::uint32_t> Placed_mesh::renumber(const Changed_faces& changed, Workers& workers) {
  // Copied first: if memory ran out later, the mesh would be numbered anew beside the former surface.
  std::vector<std::uint32_t> listed(changed.faces.begin(), changed.faces.end());
  if (faces_.joined.empty() && mesh().renumber(changed.faces)) return listed;
  Faces anew(mesh().renumbered(workers), {});
  check_faces(changed.faces, anew.corners().size());
  const std::size_t former_faces = corners().size();
  listed = replace(std::move(anew));
  std::erase_if(listed, [&](std::uint32_t face) { return face >= former_faces; });
  return listed;
}

std::vector<std::uint32_t> Placed_mesh::replace(Faces anew) {
  auto changed = changed_faces(corners(), anew.corners());
  faces_ = std::move(anew);
  return changed;
}

Positions Placed_mesh::checked(const Eigen::Ref<const Positions>& positions, const char* when) const {
  if (positions.rows() != mesh().vertex_count())
    throw Bad_mesh(title_ + " has " + std::to_string(mesh().vertex_count()) + " vertices, but got " +
                   std::to_string(positions.rows()) + " positions" + when);
  Positions copy = positions;
  check_finite({copy.data(), static_cast<std::size_t>(copy.size())}, title_ + when);
  return copy;
}

void Placed_mesh::give(std::optional<Positions> positions) {
  if (given_ || positions) ++changes_;
  given_ = std::move(positions);
}

void Placed_mesh::place(const std::optional<Rigid_motion>& placement) {
  placement_ = placement;
  ++changes_;
}

Coordinates Placed_mesh::read() {
  mesh().check_connectivity(title_);
  const Coordinates unplaced =
      given_ ? Coordinates(given_->data(), static_cast<std::size_t>(given_->size())) : mesh().read();
  return placement_ ? (*placement_)(unplaced, in_place_) : unplaced;
}

Eigen::Vector3d Placed_mesh::read(std::uint32_t vertex) const {
  const Eigen::Vector3d position = given_ ? Eigen::Vector3d(given_->row(vertex)) : mesh().read(vertex);
  return placement_ ? (*placement_)(position) : position;
}

void Placed_mesh::read(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const {
  if (!given_) mesh().read(vertices, coordinates);
  if (!given_ && !placement_) return;
  for (const std::uint32_t vertex : vertices) {
    Eigen::Map<Eigen::Vector3d> position(coordinates.data() + 3 * std::size_t{vertex});
    if (given_) position = given_->row(vertex);
    if (placement_) position = (*placement_)(position);
  }
}

}  // namespace lodestone
