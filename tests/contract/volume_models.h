// SPDX-License-Identifier: GPL-3.0-or-later
// The models of Bounding_volume as types of a test suite. Every model in the library's list is tested everywhere.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "lodestone/volumes/all.h"
#include "support/face_soup.h"
#include "support/leaves.h"

namespace lodestone {

template <class Tuple>
struct Types_of;
template <class... Volumes>
struct Types_of<std::tuple<Volumes...>> {
  using type = ::testing::Types<Volumes...>;
};
using Volume_types = Types_of<Bounding_volumes>::type;

/// The name of a suite states its model.
struct Volume_names {
  template <class Volume>
  static std::string GetName(int) {
    std::string name(Volume::name);
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
  }
};

/// The faces of a soup as one leaf.
inline Leaf leaf_of(const Face_soup& soup) {
  Leaf leaf;
  leaf.coordinates = soup.coordinates;
  for (const auto& face : soup.faces) leaf.vertices.insert(leaf.vertices.end(), face.begin(), face.end());
  std::ranges::sort(leaf.vertices);
  leaf.vertices.erase(std::unique(leaf.vertices.begin(), leaf.vertices.end()), leaf.vertices.end());
  for (const auto& face : soup.faces) {
    Leaf_corners places{};
    for (int corner = 0; corner < 3; ++corner)
      places[corner] =
          static_cast<std::uint16_t>(std::ranges::lower_bound(leaf.vertices, face[corner]) - leaf.vertices.begin());
    leaf.corners.push_back(places);
  }
  return leaf;
}

template <class Volume>
Volume volume_of(const Face_soup& soup) {
  return volume_of<Volume>(leaf_of(soup));
}

/// The volume of a single face.
template <class Volume>
Volume volume_of(const Triangle& t) {
  std::array<double, 9> coordinates{};
  for (std::size_t i = 0; i < 9; ++i) coordinates[i] = t[i / 3][static_cast<int>(i % 3)];
  constexpr std::array<std::uint32_t, 3> vertices{0, 1, 2};
  constexpr std::array<Leaf_corners, 1> corners{{{0, 1, 2}}};
  Volume volume;
  volume.enclose(Leaf_faces{.coordinates = coordinates, .vertices = vertices, .corners = corners});
  return volume;
}

/// A soup of separate triangles.
inline Face_soup soup_of(const std::vector<Triangle>& triangles) {
  Face_soup soup;
  for (const auto& t : triangles) {
    const std::uint32_t first = soup.vertex_count();
    for (const auto& p : t) soup.coordinates.insert(soup.coordinates.end(), {p.x(), p.y(), p.z()});
    soup.faces.push_back({first, first + 1, first + 2});
  }
  return soup;
}

}  // namespace lodestone
