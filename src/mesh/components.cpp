// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/components.h"

#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <numeric>

namespace lodestone {

std::vector<std::uint32_t> component_vertices(std::uint32_t vertex_count, std::span<const Corners> faces) {
  std::vector<std::uint32_t> rank(vertex_count), parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto identity = boost::typed_identity_property_map<std::uint32_t>();
  boost::disjoint_sets components(boost::make_iterator_property_map(rank.begin(), identity),
                                  boost::make_iterator_property_map(parent.begin(), identity));
  for (const auto& [a, b, c] : faces) {
    components.union_set(a, b);
    components.union_set(a, c);
  }
  std::vector<bool> seen(vertex_count);
  std::vector<std::uint32_t> found;
  for (const auto& face : faces) {
    const std::uint32_t component = components.find_set(face[0]);
    if (!seen[component]) found.push_back(face[0]);
    seen[component] = true;
  }
  return found;
}

}  // namespace lodestone
