// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/surface_report.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "lodestone/mesh/components.h"
#include "lodestone/mesh/joined_vertices.h"

namespace lodestone {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// All edges, once per face, sorted. A face that names a vertex twice has no edge between the two.
std::vector<Edge> sorted_edges(std::span<const Corners> faces) {
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (const auto& face : faces)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto [low, high] = std::minmax(face[corner], face[(corner + 1) % 3]);
      if (low != high) edges.emplace_back(low, high);
    }
  std::ranges::sort(edges);
  return edges;
}

void count_edges(std::span<const Corners> faces, Surface_report& report) {
  const auto edges = sorted_edges(faces);
  report.closed = !edges.empty();
  for (auto first = edges.begin(); first != edges.end();) {
    const auto next = std::upper_bound(first, edges.end(), *first);
    const auto around = next - first;
    report.border_edges += around == 1 ? 1 : 0;
    report.non_manifold_edges += around > 2 ? 1 : 0;
    report.closed &= around % 2 == 0;
    first = next;
  }
}

std::size_t count_duplicates(std::span<const Point> points) {
  std::vector<std::array<double, 3>> sorted;
  sorted.reserve(points.size());
  for (const Point& p : points) sorted.push_back({p.x() + 0.0, p.y() + 0.0, p.z() + 0.0});  // minus zero is zero
  std::ranges::sort(sorted);
  return static_cast<std::size_t>(sorted.end() - std::unique(sorted.begin(), sorted.end()));
}

}  // namespace

Surface_report inspect_surface(std::span<const Point> points, std::span<const Corners> faces) {
  Surface_report report;
  report.vertices = points.size();
  report.faces = faces.size();
  count_edges(faces, report);
  const auto vertex_count = static_cast<std::uint32_t>(points.size());
  report.components = component_vertices(vertex_count, faces).size();
  report.unused_vertices = unused_vertices(faces, vertex_count).size();
  report.duplicate_vertices = count_duplicates(points);
  for (const auto& [a, b, c] : faces) {
    report.degenerate_faces += CGAL::collinear(points[a], points[b], points[c]) ? 1 : 0;
    for (const auto vertex : {a, b, c}) report.box.extend(coordinates(points[vertex]));
  }
  return report;
}

}  // namespace lodestone
