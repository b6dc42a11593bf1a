// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/float_rounding.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/files/small_text.h"
#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/box.h"

namespace lodestone {

Float_rounding float_rounding(std::span<const Point> points, std::span<const Corners> faces) {
  Box box;
  double largest = 0;
  const auto add = [&](const Point& point) {
    box.extend(coordinates(point));
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(static_cast<double>(static_cast<float>(point[axis])) - point[axis]));
  };
  for (const auto& face : faces)
    for (const auto vertex : face) add(points[vertex]);
  if (faces.empty())
    for (const Point& point : points) add(point);
  return {.largest = largest, .diagonal = box.isEmpty() ? 0 : box.diagonal().norm()};
}

bool stores_floats(const std::filesystem::path& output) {
  const auto extension = lower_case(output.extension().string());
  return extension == ".pc2" || extension == ".mdd" || extension == ".stl" || is_gltf(output);
}

}  // namespace lodestone
