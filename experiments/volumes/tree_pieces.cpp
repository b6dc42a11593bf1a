// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/tree_pieces.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

namespace {

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Finds the highest nodes whose leaves are all in one region.
class Region_finder {
 public:
  Region_finder(const Tree_layout& layout, std::span<const Corners> corners, std::span<const Region_index> labels)
      : layout_(layout), corners_(corners), labels_(labels) {}

  std::vector<Region_piece> find() {
    visit(0, 0, layout_.leaf_count());
    return std::move(found_);
  }

 private:
  /// @param first, end  the leaves at and below node n
  void visit(std::uint32_t n, std::size_t first, std::size_t end) {
    if (region_of(first) == region_of(end - 1)) return add(n, first, end);
    const std::uint32_t second = layout_.node(n).second_child;
    const std::size_t middle = layout_.node(second).leaf;
    visit(n + 1, first, middle);
    visit(second, middle, end);
  }

  /// All faces of a leaf are in one region, and the leaves of a region follow one another.
  Region_index region_of(std::size_t leaf) const {
    const auto& [a, b, c] = corners_[layout_.faces(leaf).front()];
    return std::min({labels_[a], labels_[b], labels_[c]});
  }

  void add(std::uint32_t n, std::size_t first, std::size_t end) {
    Region_piece& piece = found_.emplace_back();
    piece.node = n;
    for (std::size_t leaf = first; leaf < end; ++leaf) {
      const auto faces = layout_.faces(leaf), vertices = layout_.vertices(leaf);
      piece.faces.insert(piece.faces.end(), faces.begin(), faces.end());
      piece.vertices.insert(piece.vertices.end(), vertices.begin(), vertices.end());
    }
    sort_unique(piece.vertices);
  }

  const Tree_layout& layout_;
  std::span<const Corners> corners_;
  std::span<const Region_index> labels_;
  std::vector<Region_piece> found_;
};

/// The directions of the k-DOPs, both ways, and others spread evenly over the sphere.
std::vector<Eigen::Vector3d> fitting_directions() {
  std::vector<Eigen::Vector3d> directions;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
  const std::size_t others = most_fitted_faces - directions.size();
  for (std::size_t i = 0; i < others; ++i) {  // along a spiral from pole to pole
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(others);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5));
    directions.emplace_back(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
  }
  return directions;
}

/// The vertices of a region that lie farthest in some direction, ascending.
std::vector<std::uint32_t> farthest_vertices(const Region_piece& region, Coordinates coordinates) {
  static const auto directions = fitting_directions();
  std::vector<std::uint32_t> farthest;
  for (const auto& direction : directions)
    farthest.push_back(*std::ranges::max_element(region.vertices, {}, [&](std::uint32_t vertex) {
      return direction.dot(Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}));
    }));
  sort_unique(farthest);
  return farthest;
}

/// For each of the given vertices a face that uses it.
std::vector<std::uint32_t> faces_of(const std::vector<std::uint32_t>& vertices, const Region_piece& region,
                                    std::span<const Corners> corners) {
  std::vector<std::uint32_t> faces;
  std::vector<bool> has_face(vertices.size());
  for (const auto face : region.faces)
    for (const auto corner : corners[face]) {
      const auto found = std::ranges::lower_bound(vertices, corner);
      if (found == vertices.end() || *found != corner) continue;
      const auto index = static_cast<std::size_t>(found - vertices.begin());
      if (!has_face[index]) faces.push_back(face);
      has_face[index] = true;
    }
  sort_unique(faces);
  return faces;
}

double hull_volume(const std::vector<Point>& points) {
  Surface_mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  if (!CGAL::is_triangle_mesh(hull) || !CGAL::is_closed(hull) || hull.number_of_faces() < 4) return 0;
  return CGAL::to_double(CGAL::Polygon_mesh_processing::volume(hull));
}

}  // namespace

Tree_pieces pieces_of(const Tree_layout& layout, std::span<const Corners> corners,
                      std::span<const Region_index> labels) {
  Tree_pieces pieces;
  const std::size_t leaves = layout.leaf_count(), measured = std::min(leaves, most_measured_leaves);
  for (std::size_t i = 0; i < measured; ++i) pieces.leaves.push_back(static_cast<std::uint32_t>(i * leaves / measured));
  pieces.regions = Region_finder(layout, corners, labels).find();
  return pieces;
}

Chosen_faces choose_faces(const Region_piece& region, std::span<const Corners> corners, Coordinates coordinates) {
  const auto faces = region.faces.size() <= most_fitted_faces
                         ? region.faces
                         : faces_of(farthest_vertices(region, coordinates), region, corners);
  Chosen_faces chosen{.vertices = {}, .corners = {}, .complete = faces.size() == region.faces.size()};
  for (const auto face : faces)
    chosen.vertices.insert(chosen.vertices.end(), corners[face].begin(), corners[face].end());
  sort_unique(chosen.vertices);
  const auto index_of = [&](std::uint32_t vertex) {
    return static_cast<std::uint16_t>(std::ranges::lower_bound(chosen.vertices, vertex) - chosen.vertices.begin());
  };
  for (const auto face : faces) {
    const auto& [a, b, c] = corners[face];
    chosen.corners.push_back({index_of(a), index_of(b), index_of(c)});
  }
  return chosen;
}

double hull_volume(Coordinates coordinates, std::span<const std::uint32_t> vertices) {
  const std::size_t step = (vertices.size() + most_hull_points - 1) / most_hull_points;
  std::vector<Point> points;
  for (std::size_t i = 0; i < vertices.size(); i += step) {
    const double* at = coordinates.data() + 3 * std::size_t{vertices[i]};
    points.emplace_back(at[0], at[1], at[2]);
  }
  return hull_volume(points);
}

double hull_volume(Coordinates coordinates) {
  std::vector<std::uint32_t> all(coordinates.size() / 3);
  std::iota(all.begin(), all.end(), 0U);
  return hull_volume(coordinates, all);
}

void add_hulls(const Tree_layout& layout, const Tree_pieces& pieces, Coordinates coordinates, Hull_sums& sums) {
  for (const auto leaf : pieces.leaves) sums.leaves += hull_volume(coordinates, layout.vertices(leaf));
  for (const auto& region : pieces.regions) sums.regions += hull_volume(coordinates, region.vertices);
  sums.objects += hull_volume(coordinates);
}

}  // namespace lodestone
