// SPDX-License-Identifier: GPL-3.0-or-later
#include "soak/soak_meshes.h"

#include <algorithm>
#include <cmath>

#include "lodestone/io/shapes/shapes.h"

namespace lodestone {

namespace {

using Random = std::mt19937_64;
using Pair = std::array<Soak_mesh, 2>;

double real(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// From low to high, all orders of magnitude alike.
double magnitude(Random& random, double low, double high) {
  return std::exp(real(random, std::log(low), std::log(high)));
}

std::uint32_t below(Random& random, std::size_t limit) { return static_cast<std::uint32_t>(random() % limit); }

Eigen::RowVector3d place(Random& random, double half_width) {
  const double x = real(random, -half_width, half_width), y = real(random, -half_width, half_width);
  return {x, y, real(random, -half_width, half_width)};
}

std::uint32_t face_count(Random& random) { return static_cast<std::uint32_t>(magnitude(random, 200, 2000)); }

/// Faces without common vertices.
std::vector<Corners> loose_faces(std::uint32_t count) {
  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < count; ++i) faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  return faces;
}

/// Faces without common vertices. Their corners are `corners(middle, size)` around random points.
template <class Make_corners>
Soak_mesh soup(Random& random, Make_corners corners) {
  Soak_mesh mesh;
  mesh.faces = loose_faces(face_count(random));
  const double size = magnitude(random, 0.05, 0.5);
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    auto& positions = mesh.poses.emplace_back(3 * mesh.faces.size(), 3);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const std::array<Eigen::RowVector3d, 3> made = corners(place(random, 1), size);
      for (int c = 0; c < 3; ++c) positions.row(static_cast<Eigen::Index>(3 * f) + c) = made[c];
    }
  }
  return mesh;
}

Pair random_soups(Random& random) {
  const auto corners = [&](const Eigen::RowVector3d& middle, double size) {
    return std::array<Eigen::RowVector3d, 3>{middle + place(random, size), middle + place(random, size),
                                             middle + place(random, size)};
  };
  return {soup(random, corners), soup(random, corners)};
}

/// Faces whose width is between a tenth of their length and its last digit, or whose middle corner lies just beside
/// the opposite edge.
Pair slivers(Random& random) {
  const auto corners = [&](const Eigen::RowVector3d& middle, double size) {
    const Eigen::RowVector3d from = middle + place(random, size), to = middle + place(random, size);
    const Eigen::RowVector3d beside = magnitude(random, 1e-17, 0.1) * place(random, 1);
    const double along = random() % 2 == 0 ? 0 : real(random, 0, 1);
    return std::array<Eigen::RowVector3d, 3>{from, to, from + along * (to - from) + beside};
  };
  return {soup(random, corners), soup(random, corners)};
}

/// Faces with and without an area: points, and exact segments in any order of their corners.
Pair zero_area(Random& random) {
  const auto corners = [&](const Eigen::RowVector3d& middle, double size) {
    // Multiples of 2^-20, so that sums are exact.
    const auto rounded = [](const Eigen::RowVector3d& p) -> Eigen::RowVector3d {
      return (p * 0x1p20).array().round() * 0x1p-20;
    };
    const Eigen::RowVector3d p = rounded(middle + place(random, size)), step = rounded(0.5 * place(random, size));
    const auto kind = random() % 5;
    if (kind == 0) return std::array<Eigen::RowVector3d, 3>{p, p, p};
    if (kind == 1) return std::array<Eigen::RowVector3d, 3>{p, p + step, p};
    if (kind == 2) return std::array<Eigen::RowVector3d, 3>{p - step, p + step, p};
    if (kind == 3) return std::array<Eigen::RowVector3d, 3>{p, p + step, p + 2 * step};
    return std::array<Eigen::RowVector3d, 3>{p, p + step, middle + place(random, size)};
  };
  return {soup(random, corners), soup(random, corners)};
}

/// Faces between points of a small grid: many touch, are coplanar, or share corners by position or by index.
Soak_mesh lattice_mesh(Random& random, std::uint32_t grid) {
  const std::uint32_t count = face_count(random);
  const std::uint32_t vertices = count / 2 + 8;
  Soak_mesh mesh;
  for (std::uint32_t f = 0; f < count; ++f) {
    const std::uint32_t first = below(random, vertices - 8);
    mesh.faces.push_back({first, first + below(random, 8), first + below(random, 8)});
  }
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    auto& positions = mesh.poses.emplace_back(vertices, 3);
    // A walk through the grid, so that vertices with near indices are near each other.
    Eigen::RowVector3d at(below(random, grid), below(random, grid), below(random, grid));
    for (std::uint32_t v = 0; v < vertices; ++v) {
      for (double& x : at) x = std::clamp(x + below(random, 3) - 1.0, 0.0, grid - 1.0);
      positions.row(v) = at;
    }
  }
  return mesh;
}

Pair lattices(Random& random) {
  const std::uint32_t grid = 4 + below(random, 29);
  return {lattice_mesh(random, grid), lattice_mesh(random, grid)};
}

/// A deformed sphere with a rough surface.
Soak_mesh sphere_mesh(Random& random) {
  const Surface_mesh mesh = icosphere(4 + below(random, 7));
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  const Positions rest = read_positions(numbering, mesh.points());
  const auto corners = numbering.corners();
  Soak_mesh result{.faces = {corners.begin(), corners.end()}, .poses = {}};
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    const double rough = magnitude(random, 0.003, 0.5);
    const Eigen::RowVector3d middle = place(random, 0.4), wave = place(random, 5), side = place(random, 0.4);
    auto& positions = result.poses.emplace_back(rest.rows(), 3);
    for (Eigen::Index v = 0; v < rest.rows(); ++v) {
      const Eigen::RowVector3d p = rest.row(v);
      positions.row(v) = p + middle + std::sin(wave.dot(p)) * side + place(random, rough);
    }
  }
  return result;
}

Pair spheres(Random& random) { return {sphere_mesh(random), sphere_mesh(random)}; }

/// Every face of the second mesh has one to three corners on a face of the first, on its edges and corners, up to
/// rounding.
Pair touching(Random& random) {
  Pair pair = random_soups(random);
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    const auto& [faces, poses] = pair[0];
    auto& positions = pair[1].poses[pose];
    for (Eigen::Index v = 0; v < positions.rows(); v += 3) {
      const auto& [a, b, c] = faces[below(random, faces.size())];
      const auto place_on_face = [&]() -> Eigen::RowVector3d {
        // Weights that are halves give corners and middles of edges; other weights give points inside.
        const auto weight = [&] { return random() % 2 == 0 ? 0.5 * below(random, 3) : real(random, 0, 1); };
        const double s = weight(), t = (1 - s) * weight();
        return (1 - s - t) * poses[pose].row(a) + s * poses[pose].row(b) + t * poses[pose].row(c);
      };
      const Eigen::RowVector3d first = place_on_face(), moved = first - positions.row(v);
      positions.row(v) = first;
      for (const Eigen::Index corner : {v + 1, v + 2}) {
        if (random() % 3 == 0)
          positions.row(corner) = place_on_face();
        else
          positions.row(corner) += moved;
      }
    }
  }
  return pair;
}

/// The second mesh is a speck on a face of the first, as small as the last digits of its coordinates.
Pair unlike_sizes(Random& random) {
  Pair pair{sphere_mesh(random), sphere_mesh(random)};
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    const auto& [faces, poses] = pair[0];
    const auto& [a, b, c] = faces[below(random, faces.size())];
    const double s = real(random, 0, 1), t = real(random, 0, 1 - s);
    const Eigen::RowVector3d there = (1 - s - t) * poses[pose].row(a) + s * poses[pose].row(b) + t * poses[pose].row(c);
    auto& positions = pair[1].poses[pose];
    const Eigen::RowVector3d middle = positions.colwise().mean();
    positions = magnitude(random, 1e-15, 0.3) * (positions.rowwise() - middle);
    positions.rowwise() += there;
  }
  return pair;
}

/// Faces in one tilted plane, up to rounding and a little more: their trees overlap in a sheet.
Pair sheets(Random& random) {
  const auto corners = [&](const Eigen::RowVector3d& middle, double size) {
    return std::array<Eigen::RowVector3d, 3>{middle + place(random, size), middle + place(random, size),
                                             middle + place(random, size)};
  };
  Pair pair{soup(random, corners), soup(random, corners)};
  for (std::size_t pose = 0; pose < soak_poses; ++pose) {
    const double thickness = random() % 4 == 0 ? 0 : magnitude(random, 1e-18, 1e-2);
    const Eigen::RowVector3d slope = random() % 4 == 0 ? Eigen::RowVector3d::Zero() : place(random, 1);
    for (auto& mesh : pair) {
      auto& positions = mesh.poses[pose];
      for (Eigen::Index v = 0; v < positions.rows(); ++v)
        positions(v, 2) = thickness * positions(v, 2) + slope.x() * positions(v, 0) + slope.y() * positions(v, 1);
    }
  }
  return pair;
}

}  // namespace

std::vector<Soak_recipe> soak_recipes() {
  return {{"random soup", random_soups},  {"deformed spheres", spheres},
          {"lattice", lattices},          {"zero-area faces", zero_area},
          {"slivers", slivers},           {"touching", touching},
          {"unlike sizes", unlike_sizes}, {"sheets", sheets}};
}

void move_to_frame_of_reference(Soak_mesh& mesh, std::size_t number) {
  for (auto& positions : mesh.poses) {
    if (number == 1) positions *= 0x1p-300;
    if (number == 2) positions *= 0x1p300;
    if (number == 3) positions.array() += 0x1p20;
    // On both sides of the limit up to which filters may rely on products of three lengths.
    if (number == 4) positions *= 0x1p-298;
    if (number == 5) positions *= 0x1p298;
  }
}

}  // namespace lodestone
