// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/float_rounding.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/files/small_text.h"
#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/box.h"

namespace lodestone {

namespace {

/// @param stored  the coordinate of a vertex that is read back
template <class Stored>
Float_rounding rounding_of(std::span<const Point> points, std::span<const Corners> faces, const Stored& stored) {
  Box box;
  double largest = 0;
  const auto add = [&](std::size_t vertex) {
    box.extend(coordinates(points[vertex]));
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(static_cast<double>(stored(vertex, axis)) - points[vertex][axis]));
  };
  for (const auto& face : faces)
    for (const auto vertex : face) add(vertex);
  if (faces.empty())
    for (std::size_t vertex = 0; vertex < points.size(); ++vertex) add(vertex);
  return {.largest = largest, .diagonal = box.isEmpty() ? 0 : box.diagonal().norm()};
}

}  // namespace

Float_rounding float_rounding(std::span<const Point> points, std::span<const Corners> faces) {
  return rounding_of(points, faces,
                     [&](std::size_t vertex, int axis) { return static_cast<float>(points[vertex][axis]); });
}

Float_rounding float_rounding(std::span<const Point> points, std::span<const Point> first,
                              std::span<const Corners> faces) {
  auto rounding = rounding_of(points, faces, [&](std::size_t vertex, int axis) {
    const auto base = static_cast<float>(first[vertex][axis]), found = static_cast<float>(points[vertex][axis]);
    return base + static_cast<float>(static_cast<double>(found) - static_cast<double>(base));
  });
  rounding.of_difference = true;
  return rounding;
}

bool stores_floats(const std::filesystem::path& output) {
  const auto extension = lower_case(output.extension().string());
  return extension == ".pc2" || extension == ".mdd" || extension == ".stl" || is_gltf(output);
}

}  // namespace lodestone
