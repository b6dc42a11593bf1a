// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/vertex_fans.h"

#include <algorithm>
#include <array>
#include <limits>

namespace lodestone {

namespace {

/// Calls `visit` once for each vertex of a face, even if the face uses it twice.
template <class Visit>
void for_each_vertex(const Corners& corners, Visit visit) {
  const auto& [a, b, c] = corners;
  visit(a);
  if (b != a) visit(b);
  if (c != a && c != b) visit(c);
}

}  // namespace

/// Sorts fans into rows, one vertex at a time. A class, so that its table over all vertices is allocated once.
class Vertex_fans::Ordering {
 public:
  Ordering(std::uint32_t vertex_count, std::span<const Corners> mesh_faces)
      : mesh_faces_(mesh_faces), joints_(vertex_count, no_joint) {}

  /// Reorders `faces`, the fan of `vertex`, and fills `rim`, which is one entry longer. Changes neither if the faces do
  /// not form a single row.
  void put_in_a_row(std::uint32_t vertex, std::span<std::uint32_t> faces, std::span<std::uint32_t> rim) {
    sides_.clear();
    bool simple = !faces.empty();
    for (const auto face : faces) {
      sides_.push_back(opposite_side(mesh_faces_[face], vertex));
      const auto& [p, q] = sides_.back();
      simple = simple && p != q && p != vertex && q != vertex;
    }
    if (simple && join() && walk()) {
      std::ranges::copy(rim_, rim.begin());
      for (std::size_t i = 0; i < faces.size(); ++i) order_[i] = faces[order_[i]];
      std::ranges::copy(order_, faces.begin());
    }
    for (const auto& side : sides_)
      for (const auto neighbour : side) joints_[neighbour] = no_joint;
  }

 private:
  using Side = std::array<std::uint32_t, 2>;
  /// The indices of the one or two sides that end in a neighbour.
  using Joint = std::array<std::uint32_t, 2>;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr Joint no_joint{none, none};

  /// The two other corners, in the face's order. If the face uses the vertex twice, one of them is the vertex.
  static Side opposite_side(const Corners& corners, std::uint32_t vertex) {
    const auto& [a, b, c] = corners;
    if (a == vertex) return {b, c};
    if (b == vertex) return {c, a};
    return {a, b};
  }

  /// Finds the sides that end in each neighbour; false if more than two end in one.
  bool join() {
    for (std::uint32_t side = 0; side < sides_.size(); ++side)
      for (const auto neighbour : sides_[side]) {
        auto& [one, two] = joints_[neighbour];
        if (two != none) return false;
        (one == none ? one : two) = side;
      }
    return true;
  }

  /// Follows the sides from an open end, or from anywhere if there is none; false if this does not reach all of them.
  bool walk() {
    std::uint32_t neighbour = sides_[0][0];
    for (const auto& side : sides_)
      for (const auto end : side)
        if (joints_[end][1] == none) neighbour = end;

    rim_.assign(1, neighbour);
    order_.clear();
    std::uint32_t side = joints_[neighbour][0];
    while (side != none && order_.size() < sides_.size()) {
      if (!order_.empty() && neighbour == rim_.front()) return false;  // closed, but faces are left
      order_.push_back(side);
      neighbour = sides_[side][sides_[side][0] == neighbour ? 1 : 0];
      rim_.push_back(neighbour);
      const auto& [one, two] = joints_[neighbour];
      side = one == side ? two : one;
    }
    return order_.size() == sides_.size();
  }

  std::span<const Corners> mesh_faces_;
  std::vector<Joint> joints_;  ///< per vertex of the mesh
  std::vector<Side> sides_;    ///< per face of the current fan
  std::vector<std::uint32_t> order_, rim_;
};

Vertex_fans::Vertex_fans(std::uint32_t vertex_count, std::span<const Corners> faces)
    : starts_(std::size_t{vertex_count} + 1, 0) {
  for (const auto& corners : faces) for_each_vertex(corners, [&](std::uint32_t v) { ++starts_[v]; });
  // Each entry of `starts_` is set to the end of its list first. Filling the list backwards moves it to the start.
  std::size_t end = 0;
  for (auto& start : starts_) start = end += start;
  faces_.resize(end);
  for (auto face = static_cast<std::uint32_t>(faces.size()); face-- > 0;)
    for_each_vertex(faces[face], [&](std::uint32_t v) { faces_[--starts_[v]] = face; });

  rims_.resize(end + vertex_count);
  Ordering ordering(vertex_count, faces);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    const std::size_t count = starts_[v + 1] - starts_[v];
    const std::span rim(rims_.data() + starts_[v] + v, count + 1);
    rim.front() = v;
    ordering.put_in_a_row(v, {faces_.data() + starts_[v], count}, rim);
  }
}

}  // namespace lodestone
