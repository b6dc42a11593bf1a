// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "lodestone/mesh/seams.h"
#include "lodestone/particles/walked_surface.h"
#include "support/face_soup.h"

namespace lodestone {

/// A surface that particles can walk on, with all that it consists of. Not movable, since its view refers to it.
class Owned_surface {
 public:
  /// @param seams_closed  whether particles walk across seams
  explicit Owned_surface(Face_soup soup, bool seams_closed = false)
      : soup_(std::move(soup)), walked_(soup_.faces), positions_(soup_.coordinates.data()) {
    if (seams_closed) {
      const auto border = open_border(soup_.vertex_count(), soup_.faces);
      if (const auto seams = close_seams(soup_.faces, border, soup_.positions()))
        for (auto& face : walked_)
          for (auto& corner : face) corner = seams->joined(corner);
    }
    graph_ = vertex_graph(soup_.vertex_count(), walked_);
    vertex_faces_ = Vertex_faces(soup_.vertex_count(), walked_);
  }
  Owned_surface(const Owned_surface&) = delete;
  Owned_surface& operator=(const Owned_surface&) = delete;

  Walked_surface view() const { return {&graph_, &vertex_faces_, walked_, soup_.faces, &positions_}; }
  const Face_soup& soup() const { return soup_; }
  const std::vector<Corners>& walked() const { return walked_; }
  const Vertex_graph& graph() const { return graph_; }
  Eigen::Vector3d at(std::uint32_t vertex) const { return positions_(vertex); }
  /// The coordinates, which may be changed.
  std::vector<double>& coordinates() { return soup_.coordinates; }

 private:
  Face_soup soup_;
  std::vector<Corners> walked_;
  Vertex_graph graph_;
  Vertex_faces vertex_faces_;
  Live_positions positions_;
};

}  // namespace lodestone
