// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/component_orientation.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace lodestone {
namespace {

/// Disjoint sets of faces, each named by its lowest face.
class Face_sets {
 public:
  explicit Face_sets(std::size_t faces) : parent_(faces) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t face) {
    while (parent_[face] != face) face = parent_[face] = parent_[parent_[face]];
    return face;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// One side of a face.
struct Side {
  std::uint32_t low = 0, high = 0;  ///< the vertices of the edge
  std::uint32_t face = 0;
  int direction = 0;  ///< 1: from low to high; -1: from high to low
};

/// Sorted by edge. A face that names a vertex twice has no side between the two.
std::vector<Side> sorted_sides(std::span<const Corners> faces) {
  std::vector<Side> sides;
  sides.reserve(3 * faces.size());
  for (std::uint32_t face = 0; face < faces.size(); ++face)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = faces[face][corner], to = faces[face][(corner + 1) % 3];
      if (from != to) sides.push_back({std::min(from, to), std::max(from, to), face, from < to ? 1 : -1});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.low, s.high, s.face); });
  return sides;
}

/// Calls `visit` with the sides at each edge.
template <class Visit>
void for_each_edge(std::span<const Side> sides, const Visit& visit) {
  for (std::size_t first = 0, next = 0; first < sides.size(); first = next) {
    while (next < sides.size() && sides[next].low == sides[first].low && sides[next].high == sides[first].high) ++next;
    visit(sides.subspan(first, next - first));
  }
}

Face_sets connected_by_vertices(std::span<const Corners> faces, std::size_t vertices) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  Face_sets components(faces.size());
  std::vector<std::uint32_t> face_at(vertices, none);
  for (std::uint32_t face = 0; face < faces.size(); ++face)
    for (const auto vertex : faces[face]) {
      if (face_at[vertex] != none) components.join(face, face_at[vertex]);
      face_at[vertex] = face;
    }
  return components;
}

/// What is known of a component before its volume.
struct Edges_report {
  bool open = false;
  bool consistent = true;
};

/// By the first face of each component.
std::vector<Edges_report> inspect_edges(std::span<const Side> sides, Face_sets& components, std::size_t faces) {
  std::vector<Edges_report> reports(faces);
  for_each_edge(sides, [&](std::span<const Side> around) {
    auto& report = reports[components.find(around[0].face)];
    int balance = 0;
    for (const auto& side : around) balance += side.direction;
    const int unpaired = static_cast<int>(around.size() % 2);
    report.open |= unpaired == 1;
    report.consistent &= std::abs(balance) <= unpaired;
  });
  return reports;
}

/// The smallest sets of faces that enclose a volume of their own, if all edges of the component are balanced: as many
/// sides run one way as the other. Bodies that share an edge of four faces stay apart.
Face_sets split_into_parts(std::span<const Side> sides, std::size_t faces) {
  Face_sets parts(faces);
  for_each_edge(sides, [&](std::span<const Side> around) {
    if (around.size() == 2) parts.join(around[0].face, around[1].face);
  });
  std::vector<std::pair<std::uint32_t, int>> balances;  // a part and a direction, per side
  for_each_edge(sides, [&](std::span<const Side> around) {
    if (around.size() == 2) return;
    balances.clear();
    for (const auto& side : around) balances.emplace_back(parts.find(side.face), side.direction);
    std::ranges::sort(balances);
    std::optional<std::uint32_t> unbalanced;
    for (std::size_t first = 0, next = 0; first < balances.size(); first = next) {
      int balance = 0;
      for (; next < balances.size() && balances[next].first == balances[first].first; ++next)
        balance += balances[next].second;
      if (balance == 0) continue;
      if (unbalanced) parts.join(*unbalanced, balances[first].first);
      unbalanced = balances[first].first;
    }
  });
  return parts;
}

/// Six times the volume between the faces and an apex, which does not matter for a closed surface.
template <class Number>
Number six_volumes(std::span<const Point> points, std::span<const Corners> faces,
                   std::span<const std::uint32_t> chosen) {
  const Point& apex = points[faces[chosen[0]][0]];
  const auto from_apex = [&](std::uint32_t vertex) {
    std::array<Number, 3> edge;
    for (int axis = 0; axis < 3; ++axis) edge[axis] = Number(points[vertex][axis]) - Number(apex[axis]);
    return edge;
  };
  Number sum = 0;
  for (const auto face : chosen) {
    const auto a = from_apex(faces[face][0]), b = from_apex(faces[face][1]), c = from_apex(faces[face][2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      sum += a[i] * (b[j] * c[k] - b[k] * c[j]);
    }
  }
  return sum;
}

CGAL::Sign volume_sign(std::span<const Point> points, std::span<const Corners> faces,
                       std::span<const std::uint32_t> chosen) {
  {
    const CGAL::Protect_FPU_rounding<true> upwards;
    const auto sign = CGAL::sign(six_volumes<CGAL::Interval_nt<false>>(points, faces, chosen));
    if (CGAL::is_certain(sign)) return CGAL::get_certain(sign);
  }
  return CGAL::sign(six_volumes<CGAL::Exact_rational>(points, faces, chosen));
}

/// The orientation of a closed component from the signs of the volumes of its parts.
struct Volume_signs {
  bool positive = false, negative = false;

  Face_orientation orientation() const {
    if (positive && negative) return Face_orientation::mixed;
    if (positive) return Face_orientation::outward;
    return negative ? Face_orientation::inward : Face_orientation::no_volume;
  }
};

/// By the first face of each component; of those alone that are closed and consistent.
std::vector<Volume_signs> find_volume_signs(std::span<const Point> points, std::span<const Corners> faces,
                                            Face_sets& components, Face_sets& parts,
                                            std::span<const Edges_report> edges) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_part;  // part, face
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    const auto& report = edges[components.find(face)];
    if (!report.open && report.consistent) by_part.emplace_back(parts.find(face), face);
  }
  std::ranges::sort(by_part);
  std::vector<Volume_signs> signs(faces.size());
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < by_part.size(); ++i) {
    chosen.push_back(by_part[i].second);
    if (i + 1 < by_part.size() && by_part[i + 1].first == by_part[i].first) continue;
    const auto sign = volume_sign(points, faces, chosen);
    auto& component = signs[components.find(chosen[0])];
    component.positive |= sign == CGAL::POSITIVE;
    component.negative |= sign == CGAL::NEGATIVE;
    chosen.clear();
  }
  return signs;
}

/// One entry per component, without its orientation.
std::vector<Component_orientation> list_components(Face_sets& components, std::size_t faces) {
  std::vector<Component_orientation> list;
  for (std::uint32_t face = 0; face < faces; ++face)
    if (components.find(face) == face) list.push_back({.first_face = face});
  return list;
}

/// Counts the faces of each component, and names its first one, as the file does.
void count_faces(std::vector<Component_orientation>& list, Face_sets& components, std::size_t faces,
                 std::span<const std::uint32_t> file_face) {
  std::vector<std::size_t> counts(faces, 0);
  for (std::uint32_t face = 0; face < faces; ++face)
    if (file_face.empty() || face == 0 || file_face[face] != file_face[face - 1]) ++counts[components.find(face)];
  for (auto& component : list) {
    component.faces = counts[component.first_face];
    if (!file_face.empty()) component.first_face = file_face[component.first_face];
  }
}

}  // namespace

Orientation_words words_of(Face_orientation orientation) {
  switch (orientation) {
    case Face_orientation::outward:
      return {"outward", "outward"};
    case Face_orientation::inward:
      return {"inward", "inward"};
    case Face_orientation::mixed:
      return {"mixed", "partly outward and partly inward"};
    case Face_orientation::inconsistent:
      return {"inconsistent", "inconsistent"};
    case Face_orientation::no_volume:
      return {"no_volume", "without volume"};
    case Face_orientation::open:
      return {"open", "open and consistent"};
    case Face_orientation::open_inconsistent:
      return {"open_inconsistent", "open and inconsistent"};
  }
  return {};
}

std::vector<Component_orientation> component_orientations(std::span<const Point> points, std::span<const Corners> faces,
                                                          std::span<const std::uint32_t> file_face) {
  const auto sides = sorted_sides(faces);
  auto components = connected_by_vertices(faces, points.size());
  const auto edges = inspect_edges(sides, components, faces.size());
  auto parts = split_into_parts(sides, faces.size());
  const auto signs = find_volume_signs(points, faces, components, parts, edges);
  auto list = list_components(components, faces.size());
  for (auto& component : list) {
    const auto& [open, consistent] = edges[component.first_face];
    if (open)
      component.orientation = consistent ? Face_orientation::open : Face_orientation::open_inconsistent;
    else
      component.orientation = consistent ? signs[component.first_face].orientation() : Face_orientation::inconsistent;
  }
  count_faces(list, components, faces.size(), file_face);
  return list;
}

}  // namespace lodestone
