// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Value of the particle map at a vertex without a particle.
inline constexpr Region_index no_particle = std::numeric_limits<Region_index>::max();

/// Type of the property maps that hold the regions and particles of a mesh.
template <class Mesh>
struct Region_property {
  /// Property map from vertices to regions.
  using Map = typename boost::property_map<Mesh, CGAL::dynamic_vertex_property_t<Region_index>>::const_type;
  /// Makes a map; the mesh does not keep it, and it has no name.
  static Map add(const Mesh& mesh, const char* /*name*/) {
    return get(CGAL::dynamic_vertex_property_t<Region_index>(), mesh);
  }
};

/// The properties of CGAL::Surface_mesh have names, so other code finds `v:region` and `v:particle` on the mesh.
template <class P>
struct Region_property<CGAL::Surface_mesh<P>> {
  using Mesh = CGAL::Surface_mesh<P>;  ///< the mesh type
  /// Property map from vertices to regions.
  using Map = typename Mesh::template Property_map<typename Mesh::Vertex_index, Region_index>;
  /// The map of this name, which is added to the mesh if it has none: `no_particle` everywhere.
  static Map add(Mesh& mesh, const char* name) {
    return mesh.template add_property_map<typename Mesh::Vertex_index, Region_index>(name, no_particle).first;
  }
};

/// Regions and particles of one object on its mesh: `v:region` gives the region of each vertex, `v:particle` the region
/// whose particle is on a vertex, or `no_particle`.
template <Triangle_mesh Mesh>
class Region_maps {
 public:
  using Map = typename Region_property<Mesh>::Map;  ///< from vertices to regions

  /// Gets the maps from the mesh, or adds them.
  /// @param mesh  must outlive this
  explicit Region_maps(Mesh& mesh)
      : mesh_(&mesh),
        region_(Region_property<Mesh>::add(mesh, "v:region")),
        particle_(Region_property<Mesh>::add(mesh, "v:particle")) {}

  /// Gets the maps from the mesh again, or adds them. Needed after `Surface_mesh::clear`, which frees them.
  void renew() { *this = Region_maps(*mesh_); }

  /// Region of each vertex.
  const Map& region() const { return region_; }
  /// Region whose particle is on a vertex, or `no_particle`.
  const Map& particle() const { return particle_; }

  /// Writes the label of every vertex, and all particles. O(V).
  void write(const Mesh_numbering<Mesh>& numbering, const std::vector<Region_index>& labels,
             const std::vector<std::uint32_t>& particles) {
    for (std::uint32_t v = 0; v < labels.size(); ++v) {
      put(region_, numbering.vertex(v), labels[v]);
      put(particle_, numbering.vertex(v), no_particle);
    }
    written_.clear();
    move_particles(numbering, particles);
  }

  /// Moves the particles from the vertices of the last write to the given ones. O(N).
  void move_particles(const Mesh_numbering<Mesh>& numbering, const std::vector<std::uint32_t>& particles) {
    for (const auto v : written_) put(particle_, numbering.vertex(v), no_particle);
    for (Region_index region = 0; region < particles.size(); ++region)
      put(particle_, numbering.vertex(particles[region]), region);
    written_ = particles;
  }

 private:
  Mesh* mesh_;
  Map region_, particle_;
  std::vector<std::uint32_t> written_;  ///< per region: the vertex of the last write
};

}  // namespace lodestone
