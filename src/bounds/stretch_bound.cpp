// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/stretch_bound.h"

#include <cmath>

#include "bounds/grown_box.h"
#include "bounds/landmark_search.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

namespace {

constexpr double slack = 1e-9;

/// The three edges of a face.
struct Face_edges {
  Eigen::Vector3d ab, bc, ca;

  Face_edges(Coordinates coordinates, const Corners& face) {
    const auto at = [&](std::uint32_t v) {
      return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{v});
    };
    const Eigen::Vector3d a = at(face[0]), b = at(face[1]), c = at(face[2]);
    ab = b - a;
    bc = c - b;
    ca = a - c;
  }
};

}  // namespace

Stretch_bound::Stretch_bound(const Stretch_promise& promise, const Bounded_object& object)
    : promise_(&promise), layout_(&object.layout), positions_(&object.positions) {
  check_object(object);
  rest_.assign(object.rest.begin(), object.rest.end());
  const auto nodes = static_cast<std::uint32_t>(layout_->node_count());
  const double longer = 1 + (2 * slack + 0x1p-51 * static_cast<double>(positions_->vertex_count()));
  begin_.resize(nodes);
  end_.resize(nodes);
  Landmark_search search(*layout_, rest_);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const auto found = search.find(node);
    if (!found.empty()) {
      begin_[node] = static_cast<std::uint32_t>(landmarks_.size());
      for (const auto& [vertex, radius] : found) landmarks_.push_back({.vertex = vertex, .radius = longer * radius});
      end_[node] = static_cast<std::uint32_t>(landmarks_.size());
    }
    if (layout_->is_leaf(node)) continue;
    // Those of this node, until the children find their own.
    for (const auto child : {node + 1, layout_->node(node).second_child}) {
      begin_[child] = begin_[node];
      end_[child] = end_[node];
    }
  }
}

Aabb Stretch_bound::box(std::uint32_t node) const {
  const double error = 2 * (1 + slack) * promise_->error();
  const auto around = [&](const Landmark& landmark) {
    return box_around((*positions_)(landmark.vertex), promise_->stretch() * landmark.radius + error);
  };
  const auto all = landmarks(node);
  Aabb box = around(all.front());
  for (const auto& landmark : all.subspan(1)) box.enclose(box, around(landmark));
  return box;
}

bool Stretch_bound::note_read(std::uint32_t leaf, const Aabb& /*fitted*/, Coordinates coordinates) const {
  const double most = (1 + slack) * promise_->stretch(), error = 2 * (1 + slack) * promise_->error();
  // Not known of squares that underflow or overflow.
  const auto shorter = [&](const Eigen::Vector3d& now, const Eigen::Vector3d& then) {
    constexpr double smallest = 1e-290, largest = 1e300;
    const double longest = most * most * then.squaredNorm();
    return (now.squaredNorm() <= longest) & (longest > smallest) & (longest < largest);
  };
  // What that leaves, and the error allowed.
  const auto kept = [&](const Eigen::Vector3d& now, const Eigen::Vector3d& then) {
    constexpr double smallest = 1e-150;
    return shorter(now, then) || now.stableNorm() <= most * (then.stableNorm() + smallest) + error;
  };
  const auto vertices = layout_->vertices(leaf);
  for (const auto& [a, b, c] : layout_->corners(leaf)) {
    const Corners face{vertices[a], vertices[b], vertices[c]};
    const Face_edges now(coordinates, face), then(rest_, face);
    if (shorter(now.ab, then.ab) & shorter(now.bc, then.bc) & shorter(now.ca, then.ca)) continue;
    if (!kept(now.ab, then.ab) || !kept(now.bc, then.bc) || !kept(now.ca, then.ca)) return false;
  }
  return true;
}

void Stretch_promise::set_stretch(double stretch, double error) {
  if (!(stretch >= 0) || !std::isfinite(stretch)) throw Bad_argument("a stretch must be >= 0 and finite");
  if (!(error >= 0) || !std::isfinite(error)) throw Bad_argument("the error of positions must be >= 0 and finite");
  stretch_ = stretch;
  error_ = error;
}

}  // namespace lodestone
