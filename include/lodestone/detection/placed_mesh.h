// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/watched_mesh.h"
#include "lodestone/mesh/rigid_motion.h"

namespace lodestone {

/// The faces whose corners differ, ascending, with those that only `now` has. O(F).
std::vector<std::uint32_t> changed_faces(std::span<const Corners> former, std::span<const Corners> now);

/// The mesh of an object of the mode `exact` or `certified`, and where its vertices are: where the mesh has them, or
/// the caller has said; then placed.
class Placed_mesh {
 public:
  /// @param title          names the object in messages
  /// @param file_vertex    as in Object_options
  /// @throws Bad_argument  `file_vertex` does not have one entry per vertex
  Placed_mesh(std::string title, std::unique_ptr<Watched_mesh> mesh, std::span<const std::uint32_t> file_vertex)
      : title_(std::move(title)), faces_(std::move(mesh), file_vertex) {}

  /// Names the object in messages.
  const std::string& title() const { return title_; }
  /// The mesh, whatever its type.
  Watched_mesh& mesh() const { return *faces_.mesh; }
  /// The faces of the surface, with doubled vertices as one.
  std::span<const Corners> corners() const { return faces_.corners(); }

  /// Reads the faces of the mesh anew.
  /// @return the faces that have changed, see `changed_faces`
  /// @throws Bad_mesh, Bad_argument  nothing has changed
  std::vector<std::uint32_t> renumber(std::span<const std::uint32_t> file_vertex, Workers& workers);
  /// The same, reading only what has changed where the type of the mesh allows that.
  /// @return among the faces that there were before, those that have changed
  std::vector<std::uint32_t> renumber(const Changed_faces& changed, Workers& workers);

  /// A copy of positions that were given for the vertices.
  /// @param when  which ones they are, for messages: empty, or such as " at the end"
  /// @throws Bad_mesh  another number of rows, a coordinate that is not finite
  Positions checked(const Eigen::Ref<const Positions>& positions, const char* when = "") const;
  /// Takes positions in place of those of the mesh; none: those of the mesh count again.
  void give(std::optional<Positions> positions);
  /// Places the object elsewhere from now on; none: where its mesh is.
  void place(const std::optional<Rigid_motion>& placement);
  /// Takes note that a query begins: positions can have changed since the last one.
  void note_query() {
    if (mesh().pose_number() == 0) ++changes_;
  }

  /// The positions that were given, if any.
  const std::optional<Positions>& given() const { return given_; }
  /// Where the object is placed, if not where its mesh is.
  const std::optional<Rigid_motion>& placement() const { return placement_; }
  /// Grows whenever positions may have changed.
  std::uint64_t pose_number() const { return 1 + mesh().pose_number() + changes_; }
  /// Whether all positions lie in memory as they are, so that `read` copies nothing.
  bool in_memory() const { return !placement_ && (given_ || mesh().in_memory()); }

  /// Where the vertices are now. Valid until the next call.
  /// @throws Bad_mesh  the mesh has changed since it was numbered
  Coordinates read();
  /// Where one vertex is now.
  Eigen::Vector3d read(std::uint32_t vertex) const;
  /// Where the vertices of a list are now, each to its three places among 3 V coordinates.
  void read(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const;

 private:
  /// The mesh, and what depends on its faces alone.
  struct Faces {
    Faces(std::unique_ptr<Watched_mesh> watched, std::span<const std::uint32_t> file_vertex);
    std::span<const Corners> corners() const { return joined.empty() ? mesh->corners() : std::span(joined); }

    std::unique_ptr<Watched_mesh> mesh;
    std::vector<Corners> joined;  ///< none if no vertex is doubled
  };

  std::vector<std::uint32_t> replace(Faces anew);

  std::string title_;
  Faces faces_;
  std::optional<Positions> given_;
  std::optional<Rigid_motion> placement_;
  std::uint64_t changes_ = 0;     ///< grows with given positions, with placements, and with queries of a mesh whose
                                  ///< points have no pose number
  std::vector<double> in_place_;  ///< memory of `read`
};

}  // namespace lodestone
