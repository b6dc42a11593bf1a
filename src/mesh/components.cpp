// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/components.h"

#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <limits>
#include <numeric>

namespace lodestone {

std::vector<std::uint32_t> component_of_faces(std::uint32_t vertex_count, std::span<const Corners> faces) {
  std::vector<std::uint32_t> rank(vertex_count), parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto identity = boost::typed_identity_property_map<std::uint32_t>();
  boost::disjoint_sets components(boost::make_iterator_property_map(rank.begin(), identity),
                                  boost::make_iterator_property_map(parent.begin(), identity));
  for (const auto& [a, b, c] : faces) {
    components.union_set(a, b);
    components.union_set(a, c);
  }
  constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(vertex_count, unnumbered);
  std::vector<std::uint32_t> component;
  component.reserve(faces.size());
  std::uint32_t count = 0;
  for (const auto& face : faces) {
    auto& known = number[components.find_set(face[0])];
    if (known == unnumbered) known = count++;
    component.push_back(known);
  }
  return component;
}

std::vector<std::uint32_t> component_vertices(std::uint32_t vertex_count, std::span<const Corners> faces) {
  const auto component = component_of_faces(vertex_count, faces);
  std::vector<std::uint32_t> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (component[f] == found.size()) found.push_back(faces[f][0]);
  return found;
}

}  // namespace lodestone
