// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/face_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <tuple>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/scaled_positions.h"

namespace lodestone {

namespace {

/// The share of a label in the faces around a vertex.
struct Share {
  std::uint32_t vertex = 0;
  Region_index label = 0;
  double area = 0;
  std::size_t faces = 0;
};

bool is_more(const Share& a, const Share& b) { return std::tie(a.area, a.faces) > std::tie(b.area, b.faces); }

/// One share per vertex and label, in lexicographic order of vertex and label.
std::vector<Share> shares(const Numbered_surface& surface, std::span<const Region_index> face_labels) {
  const Positions positions = scaled_positions(surface.positions);
  std::vector<Share> all;
  all.reserve(3 * face_labels.size());
  for (std::size_t f = 0; f < face_labels.size(); ++f) {
    if (face_labels[f] == no_region) continue;
    const auto& [a, b, c] = surface.faces[f];
    const Eigen::RowVector3d first = positions.row(b) - positions.row(a);
    const Eigen::RowVector3d second = positions.row(c) - positions.row(a);
    const double area = first.cross(second).norm();
    for (const auto corner : {a, b, c}) all.push_back({corner, face_labels[f], area, 1});
  }
  std::ranges::stable_sort(all, {}, [](const Share& share) { return std::pair(share.vertex, share.label); });

  std::vector<Share> merged;
  for (const auto& share : all) {
    if (merged.empty() || merged.back().vertex != share.vertex || merged.back().label != share.label) {
      merged.push_back(share);
    } else {
      merged.back().area += share.area;
      merged.back().faces += share.faces;
    }
  }
  return merged;
}

/// The label with the largest share, per vertex.
std::vector<Region_index> majorities(std::size_t vertices, const std::vector<Share>& all) {
  std::vector<Region_index> labels(vertices, no_region);
  const Share* best = nullptr;
  for (const auto& share : all)
    if (best == nullptr || best->vertex != share.vertex || is_more(share, *best)) {
      best = &share;
      labels[share.vertex] = share.label;
    }
  return labels;
}

/// Gives each label that no vertex has a vertex of a label with several.
void revive_labels(std::vector<Share> all, std::vector<Region_index>& labels) {
  std::ranges::stable_sort(all, {}, &Share::label);
  if (all.empty()) return;
  std::vector<std::size_t> sizes(all.back().label + std::size_t{1}, 0);
  for (const auto label : labels)
    if (label != no_region) ++sizes[label];
  for (auto begin = all.begin(); begin != all.end();) {
    const Region_index label = begin->label;
    const auto end = std::find_if(begin, all.end(), [&](const Share& share) { return share.label != label; });
    if (sizes[label] == 0) {
      const Share* best = nullptr;
      for (auto share = begin; share != end; ++share)
        if (sizes[labels[share->vertex]] > 1 && (best == nullptr || is_more(*share, *best))) best = &*share;
      if (best != nullptr) {
        --sizes[labels[best->vertex]];
        ++sizes[label];
        labels[best->vertex] = label;
      }
    }
    begin = end;
  }
}

/// Gives vertices without a label that of the nearest vertex that has one; 0 if there is none.
void label_the_unlabelled(const Vertex_graph& graph, std::vector<Region_index>& labels) {
  std::vector<std::uint32_t> front;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (labels[v] != no_region) front.push_back(v);
  for (std::size_t i = 0; i < front.size(); ++i)
    for (const auto w : neighbours(graph, front[i]))
      if (labels[w] == no_region) {
        labels[w] = labels[front[i]];
        front.push_back(w);
      }
  std::ranges::replace(labels, no_region, Region_index{0});
}

}  // namespace

std::vector<Region_index> vertex_labels(const Numbered_surface& surface, std::span<const Region_index> face_labels) {
  if (face_labels.size() != surface.faces.size())
    throw Bad_argument("there are " + std::to_string(face_labels.size()) + " labels for " +
                       std::to_string(surface.faces.size()) + " faces");
  const auto all = shares(surface, face_labels);
  auto labels = majorities(num_vertices(surface.graph), all);
  revive_labels(all, labels);
  label_the_unlabelled(surface.graph, labels);
  return labels;
}

}  // namespace lodestone
