// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/mesh/connectivity.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/mesh/region_maps.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// @param title      names the object in the message
/// @throws Bad_mesh  one of the coordinates is not finite
void check_finite(Coordinates coordinates, const std::string& title);
/// The same for the coordinates of some vertices.
void check_finite(Coordinates coordinates, std::span<const std::uint32_t> vertices, const std::string& title);

/// One object of the mode `exact`: its mesh, how positions are read, and its surface.
template <Triangle_mesh Mesh, class Points, Bounding_volume Volume>
class Exact_object {
 public:
  Exact_object(std::uint32_t id, const Mesh& mesh, Points points, const Object_options& options)
      : title(title_of(id, options)), particles(options.particles), mesh_(&mesh), reader_(std::move(points)), faces_(mesh, options.file_vertex) {
    surface = Basic_tree_surface<Volume>(corners());
  }

  const std::string title;              ///< names the object in messages
  const std::size_t particles;          ///< Object_options::particles
  Basic_tree_surface<Volume> surface;   ///< of `corners()`
  bool built = false;                   ///< whether the surface has a tree
  std::optional<Positions> given = {};  ///< positions that came through `update`
  std::optional<Region_maps<Mesh>> maps = {};

  const Mesh& mesh() const { return *mesh_; }
  const Mesh_numbering<Mesh>& numbering() const { return faces_.numbering; }
  /// The faces of the surface, with doubled vertices as one.
  std::span<const Corners> corners() const { return faces_.corners(); }
  /// Vertices that the surface has no face at.
  std::span<const std::uint32_t> unused() const { return faces_.unused; }

  /// Where the vertices are now.
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  Coordinates read();

  /// Reads the faces of the mesh anew; given positions, which may be those of other vertices, are dropped.
  /// @throws Bad_mesh, Bad_argument  the object stays as it was
  void rebuild(std::span<const std::uint32_t> file_vertex);

 private:
  /// What depends on the faces of the mesh alone.
  struct Faces {
    Faces(const Mesh& mesh, std::span<const std::uint32_t> file_vertex)
        : numbering(mesh),
          joined(join_vertices(numbering.corners(), numbering.vertex_count(), file_vertex)),
          unused(unused_vertices(corners(), numbering.vertex_count())) {}

    std::span<const Corners> corners() const { return joined.empty() ? numbering.corners() : joined; }

    Mesh_numbering<Mesh> numbering;
    std::vector<Corners> joined;  ///< none if no vertex is doubled
    std::vector<std::uint32_t> unused;
  };

  const Mesh* mesh_;
  Coordinate_reader<Mesh, Points> reader_;
  Faces faces_;
};

template <Triangle_mesh Mesh, class Points, Bounding_volume Volume>
Coordinates Exact_object<Mesh, Points, Volume>::read() {
  check_connectivity(*mesh_, numbering(), [this] { return title; });
  if (given) return {given->data(), static_cast<std::size_t>(given->size())};
  return reader_.read(numbering());
}

template <Triangle_mesh Mesh, class Points, Bounding_volume Volume>
void Exact_object<Mesh, Points, Volume>::rebuild(std::span<const std::uint32_t> file_vertex) {
  Faces anew(*mesh_, file_vertex);
  if (maps) maps->renew();
  // From here on nothing can fail.
  faces_ = std::move(anew);
  surface = Basic_tree_surface<Volume>(corners());
  given.reset();
  built = false;
}

}  // namespace lodestone
