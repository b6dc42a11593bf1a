// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/face_soup.h"

namespace lodestone {

Face_soup moved(Face_soup soup, double x, double y, double z) {
  deform(soup, [&](const Point& p) { return Point(p.x() + x, p.y() + y, p.z() + z); });
  return soup;
}

std::vector<std::pair<Face_soup, Face_soup>> touching_soups(std::size_t detail) {
  const Face_soup box(cube(static_cast<int>(detail))), ball(icosphere(detail)),
      sheet(cloth(2 * detail + 1, 2 * detail + 1)), lattice(lattice_soup(75 * detail, 60, 5, 1));
  return {{box, box},
          {box, moved(box, 1, 0, 0)},
          {box, moved(box, 1, 1, 1)},
          {box, moved(box, 0.25, 0.5, 1)},
          {box, moved(box, 0.3, 0.5, 1)},
          {ball, ball},
          {sheet, sheet},
          {sheet, moved(sheet, 0.125, 0.3, 0)},
          {box, moved(sheet, 0, 0.25, 1)},
          {sheet, box},
          {lattice, lattice},
          {lattice, lattice_soup(75 * detail, 60, 5, 2)}};
}

Face_soup placed(Face_soup soup, double factor, double offset) {
  for (double& x : soup.coordinates) x = factor * x + offset;
  return soup;
}

Face_soup posed_at_random(Face_soup soup, double distance, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Eigen::Vector3d(x, y, z);
  };
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(std::numbers::pi * unit(random), vector().normalized()));
  const Eigen::Vector3d step = distance * vector();
  deform(soup, [&](const Point& p) {
    const Eigen::Vector3d q = turn * coordinates(p) + step;
    return Point(q.x(), q.y(), q.z());
  });
  return soup;
}

Face_soup crumpled(Face_soup soup, double distance, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> step(0, distance);
  for (double& x : soup.coordinates) x += step(random);
  return soup;
}

Face_soup joined(Face_soup a, const Face_soup& b) {
  const std::uint32_t first = a.vertex_count();
  for (const auto& [i, j, k] : b.faces) a.faces.push_back({first + i, first + j, first + k});
  a.coordinates.insert(a.coordinates.end(), b.coordinates.begin(), b.coordinates.end());
  return a;
}

Face_soup shuffled(const Face_soup& soup, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint32_t> place(soup.vertex_count());
  std::iota(place.begin(), place.end(), 0U);
  std::ranges::shuffle(place, random);
  Face_soup result = soup;
  for (std::uint32_t v = 0; v < soup.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      result.coordinates[3 * std::size_t{place[v]} + axis] = soup.coordinates[3 * std::size_t{v} + axis];
  for (auto& corners : result.faces) {
    for (auto& corner : corners) corner = place[corner];
    std::ranges::shuffle(corners, random);
  }
  std::ranges::shuffle(result.faces, random);
  return result;
}

Face_soup lattice_soup(std::size_t faces, std::uint32_t vertices, std::uint64_t size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Face_soup soup;
  for (std::uint32_t i = 0; i < 3 * vertices; ++i) soup.coordinates.push_back(static_cast<double>(random() % size));
  soup.faces.resize(faces);
  for (auto& corners : soup.faces)
    for (auto& corner : corners) corner = static_cast<std::uint32_t>(random() % vertices);
  return soup;
}

Face_soup loose_triangles(std::uint32_t count, double size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Face_soup soup;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = unit(random), y = unit(random), z = unit(random);
    for (int corner = 0; corner < 3; ++corner)
      for (const double centre : {x, y, z}) soup.coordinates.push_back(centre + size * unit(random));
    soup.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

std::vector<Region_index> octants(const Face_soup& soup) {
  const Positions positions = soup.positions();
  const Eigen::RowVector3d mean = positions.colwise().mean();
  std::vector<Region_index> labels;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    Region_index label = 0;
    for (int axis = 0; axis < 3; ++axis) label = 2 * label + (positions(v, axis) > mean[axis] ? 1 : 0);
    labels.push_back(label);
  }
  return labels;
}

std::vector<std::pair<std::string, Face_soup>> small_objects() {
  Face_soup pot(teapot({3, 3}));
  deform(pot, [](const Point& p) { return Point(p.x() / 3, p.y() / 3, (p.z() - 1.5) / 3); });
  Face_soup sheet(cloth(16, 12));
  deform(sheet, [](const Point& p) {
    return Point(2 * p.x() - 1, 2 * p.y() - 1, 0.3 * std::sin(9 * p.x()) * std::cos(7 * p.y()));
  });
  return {{"teapot", pot},
          {"sphere", icosphere(5)},
          {"torus knot", torus_knot({.radius = 0.7, .tube = 0.1, .segments = 40, .sides = 7})},
          {"cloth", sheet},
          {"triangles", loose_triangles(300, 0.3, 1)}};
}

std::vector<Face_pair> true_pairs(const Face_soup& a, const Face_soup& b) {
  return exhaustive_numbered(a.positions(), a.faces, b.positions(), b.faces);
}

}  // namespace lodestone
