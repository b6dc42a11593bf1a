// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_fans.h"

namespace lodestone {

/// The surface of one object: its faces, the current positions of its vertices, and properties of its connectivity.
/// Only some queries need these properties, so each is computed on first use.
class Object_surface {
 public:
  Object_surface() = default;
  /// @param corners  F >= 1 faces; must outlive this object
  explicit Object_surface(std::span<const Corners> corners) : corners_(corners) {}

  /// The faces, F.
  std::span<const Corners> corners() const { return corners_; }
  /// Number of vertices, V; 0 before positions are known.
  std::size_t vertex_count() const { return coordinates_.size() / 3; }
  /// Where the vertices are in the current frame: 3 V; empty before positions are known.
  Coordinates coordinates() const { return coordinates_; }

  /// Where the vertices are at rest; empty unless kept.
  Coordinates rest() const { return rest_; }
  /// Takes the current positions as those at rest. O(V).
  void keep_rest() { rest_.assign(coordinates_.begin(), coordinates_.end()); }

  // The first call of each of the following keeps what it has found: it must not be in two threads at once.

  /// The faces around each vertex. O(V + F) the first time.
  const Vertex_fans& fans() const;
  /// Whether each edge has an even number of faces, so that the surface has an inside. O(F log F) the first time.
  bool closed() const;
  /// One vertex of each connected component of the surface. O(V + F) the first time.
  std::span<const std::uint32_t> component_vertices() const;

 protected:
  /// Takes 3 V coordinates as those at rest; none: they are not kept.
  void set_rest(std::vector<double> rest) { rest_ = std::move(rest); }

  Coordinates coordinates_;  ///< of the current frame: 3 V, or empty

 private:
  std::span<const Corners> corners_;
  std::vector<double> rest_;
  mutable std::optional<Vertex_fans> fans_;
  mutable std::optional<bool> closed_;
  mutable std::vector<std::uint32_t> component_vertices_;
};

}  // namespace lodestone
