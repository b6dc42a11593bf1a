// SPDX-License-Identifier: GPL-3.0-or-later
#include "first_answer/once_scene.h"

#include <algorithm>

#include "lodestone/io/shapes/shapes.h"

namespace lodestone {

void Once_scene::step() {
  const Kernel::Vector_3 step(0, 1e-5, 0);
  for (const auto v : b.vertices()) b.point(v) = b.point(v) + step;
}

const std::vector<Once_kind>& once_kinds() {
  static const std::vector<Once_kind> kinds{{"far", {5, 0, 0}, 1},         {"beside", {1.15, 1.15, 1.15}, 1},
                                            {"touching", {1.99, 0, 0}, 1}, {"tenth", {1.8, 0, 0}, 1},
                                            {"deep", {0.3, 0, 0}, 1},      {"inside", {0, 0, 0}, 0.5}};
  return kinds;
}

const std::vector<Once_size>& once_sizes() {
  static const std::vector<Once_size> sizes{{8, true}, {16, true}, {32, false}, {50, true}, {158, true}, {316, false}};
  return sizes;
}

std::vector<Once_size> in_order(std::vector<Once_size> sizes) {
  std::ranges::sort(sizes, {}, &Once_size::triangles);
  const auto repeated = std::ranges::unique(sizes, {}, &Once_size::triangles);
  sizes.erase(repeated.begin(), repeated.end());
  return sizes;
}

Once_scene make_once_scene(const Once_kind& kind, const Once_size& size) {
  Once_scene scene{
      .name = kind.name, .triangles = size.triangles(), .a = icosphere(size.frequency), .b = icosphere(size.frequency)};
  // Off the axes of symmetry, where no edge of one lies on an edge of the other.
  const Kernel::Vector_3 centre = kind.centre + Kernel::Vector_3(0, 0.01, 0.02);
  for (const auto v : scene.b.vertices())
    scene.b.point(v) = CGAL::ORIGIN + kind.size * (scene.b.point(v) - CGAL::ORIGIN) + centre;
  return scene;
}

}  // namespace lodestone
