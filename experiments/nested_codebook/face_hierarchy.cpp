// SPDX-License-Identifier: GPL-3.0-or-later
#include "nested_codebook/face_hierarchy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <numeric>

#include "lodestone/mesh/box.h"
#include "lodestone/partition/lbg.h"

namespace lodestone {

namespace {

Positions face_centres(const Rest_surface& surface) {
  Positions centres(static_cast<Eigen::Index>(surface.corners.size()), 3);
  for (Eigen::Index f = 0; f < centres.rows(); ++f) {
    const auto& [a, b, c] = surface.corners[static_cast<std::size_t>(f)];
    centres.row(f) = (surface.positions.row(a) + surface.positions.row(b) + surface.positions.row(c)) / 3;
  }
  return centres;
}

/// Zero for a face without area.
Eigen::RowVector3d unit_normal(const Rest_surface& surface, const Corners& corners) {
  const Eigen::RowVector3d a = surface.positions.row(corners[0]);
  const Eigen::RowVector3d b = surface.positions.row(corners[1]), c = surface.positions.row(corners[2]);
  return (b - a).cross(c - a).stableNormalized();
}

/// Makes the nodes of a Face_hierarchy.
class Hierarchy_builder {
 public:
  Hierarchy_builder(const Rest_surface& surface, std::size_t leaf_faces, const Face_split& split)
      : surface_(surface), leaf_faces_(leaf_faces), split_(split) {}

  Face_hierarchy build(std::span<const Region_index> regions) {
    hierarchy_.faces.resize(surface_.corners.size());
    std::iota(hierarchy_.faces.begin(), hierarchy_.faces.end(), 0U);
    const auto region_of = [&](std::uint32_t face) { return regions[face]; };
    std::ranges::stable_sort(hierarchy_.faces, {}, region_of);
    const auto count = static_cast<std::uint32_t>(hierarchy_.faces.size());
    for (std::uint32_t first = 0, end = 0; first < count; first = end) {
      while (end < count && region_of(hierarchy_.faces[end]) == region_of(hierarchy_.faces[first])) ++end;
      hierarchy_.roots.push_back(static_cast<std::uint32_t>(hierarchy_.nodes.size()));
      add_node(first, end);
    }
    return std::move(hierarchy_);
  }

 private:
  void add_node(std::uint32_t first, std::uint32_t end) {
    const std::size_t node = hierarchy_.nodes.size();
    hierarchy_.nodes.push_back({.first_face = first, .end_face = end});
    auto vertices = vertices_of(first, end);
    set_anchor(hierarchy_.nodes[node], vertices);
    if (end - first <= leaf_faces_) {
      hierarchy_.nodes[node].vertices = std::move(vertices);
      return;
    }
    const auto middle = first + static_cast<std::uint32_t>(split_(faces(first, end)));
    add_node(first, middle);
    hierarchy_.nodes[node].second_child = static_cast<std::uint32_t>(hierarchy_.nodes.size());
    add_node(middle, end);
  }

  std::span<std::uint32_t> faces(std::uint32_t first, std::uint32_t end) {
    return std::span(hierarchy_.faces).subspan(first, end - first);
  }

  std::vector<std::uint32_t> vertices_of(std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> vertices;
    for (const auto face : faces(first, end))
      vertices.insert(vertices.end(), surface_.corners[face].begin(), surface_.corners[face].end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  void set_anchor(Face_node& node, const std::vector<std::uint32_t>& vertices) const {
    const auto at = [&](std::uint32_t vertex) -> Eigen::Vector3d { return surface_.positions.row(vertex); };
    Box box;
    for (const auto vertex : vertices) box.extend(at(vertex));
    const Eigen::Vector3d centre = box.center();
    node.anchor = *std::ranges::min_element(vertices, {}, [&](auto v) { return (at(v) - centre).squaredNorm(); });
    for (const auto vertex : vertices) node.radius = std::max(node.radius, (at(vertex) - at(node.anchor)).norm());
  }

  const Rest_surface& surface_;
  const std::size_t leaf_faces_;
  const Face_split& split_;
  Face_hierarchy hierarchy_;
};

}  // namespace

Face_split split_at_median(const Rest_surface& surface, std::size_t leaf_faces) {
  const auto centres = std::make_shared<const Positions>(face_centres(surface));
  return [centres, leaf_faces](std::span<std::uint32_t> faces) {
    Box box;
    for (const auto face : faces) box.extend(centres->row(face).transpose());
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t leaves = (faces.size() + leaf_faces - 1) / leaf_faces;
    const std::size_t first_count = faces.size() * (leaves / 2) / leaves;
    const auto place = [&](std::uint32_t face) { return std::pair((*centres)(face, axis), face); };
    std::ranges::nth_element(faces, faces.begin() + static_cast<std::ptrdiff_t>(first_count), {}, place);
    return first_count;
  };
}

Feature_vectors face_features(const Rest_surface& surface, double normal_weight) {
  const Feature_vectors places = feature_vectors(face_centres(surface), {}, {.normal_weight = 0});
  if (normal_weight == 0) return places;
  Feature_vectors features(places.rows(), 6);
  features.leftCols<3>() = places;
  for (Eigen::Index f = 0; f < features.rows(); ++f)
    features.row(f).tail<3>() = normal_weight * unit_normal(surface, surface.corners[static_cast<std::size_t>(f)]);
  return features;
}

Face_split split_by_lbg(Feature_vectors features) {
  const auto shared = std::make_shared<const Feature_vectors>(std::move(features));
  return [shared](std::span<std::uint32_t> faces) {
    Feature_vectors rows(static_cast<Eigen::Index>(faces.size()), shared->cols());
    for (std::size_t f = 0; f < faces.size(); ++f) rows.row(static_cast<Eigen::Index>(f)) = shared->row(faces[f]);
    const auto labels = quantise(rows, 2).labels;
    std::vector<std::uint32_t> first, second;
    for (std::size_t f = 0; f < faces.size(); ++f) (labels[f] == 0 ? first : second).push_back(faces[f]);
    if (second.empty()) return faces.size() / 2;
    std::ranges::copy(second, std::ranges::copy(first, faces.begin()).out);
    return first.size();
  };
}

Face_hierarchy build_hierarchy(const Rest_surface& surface, std::span<const Region_index> regions,
                               std::size_t leaf_faces, const Face_split& split) {
  return Hierarchy_builder(surface, leaf_faces, split).build(regions);
}

}  // namespace lodestone
