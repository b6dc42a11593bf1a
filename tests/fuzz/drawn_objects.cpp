// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/drawn_objects.h"

#include <algorithm>
#include <cmath>

namespace lodestone::fuzz {

namespace {

/// A height field of n x m squares.
void make_cloth(Byte_source& bytes, std::uint32_t n, std::uint32_t m, Drawn_object& object) {
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= m; ++j)
      object.coordinates.insert(object.coordinates.end(), {double(i), double(j), bytes.coordinate()});
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t corner = i * (m + 1) + j, next = corner + m + 1;
      object.faces.push_back({corner, next, next + 1});
      object.faces.push_back({corner, next + 1, corner + 1});
    }
}

void make_tetrahedron(Drawn_object& object) {
  object.coordinates = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  object.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
}

void make_box(Drawn_object& object) {
  for (std::uint32_t v = 0; v < 8; ++v)
    object.coordinates.insert(object.coordinates.end(), {double(v & 1U), double(v >> 1U & 1U), double(v >> 2U)});
  object.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
}

/// Faces with corners of their own, or with any of some vertices.
void make_soup(Byte_source& bytes, bool loose, Drawn_object& object) {
  const auto faces = static_cast<std::uint32_t>(1 + bytes.below(8));
  const auto vertices = loose ? 3 * faces : static_cast<std::uint32_t>(3 + bytes.below(6));
  for (std::uint32_t i = 0; i < 3 * vertices; ++i) object.coordinates.push_back(bytes.coordinate());
  const auto corner = [&] { return static_cast<std::uint32_t>(bytes.below(vertices)); };
  for (std::uint32_t f = 0; f < faces; ++f)
    object.faces.push_back(loose ? Corners{3 * f, 3 * f + 1, 3 * f + 2} : Corners{corner(), corner(), corner()});
}

void place(Byte_source& bytes, Drawn_object& object) {
  const double scale = bytes.below(8) == 7 ? bytes.coordinate() : 1;
  const double offset[] = {bytes.coordinate(), bytes.coordinate(), bytes.coordinate()};
  for (std::size_t i = 0; i < object.coordinates.size(); ++i) {
    const double moved = scale * object.coordinates[i] + offset[i % 3];
    object.coordinates[i] = std::isfinite(moved) ? moved : 1;
  }
}

/// Takes other coordinates if it can be promised how far the vertices have moved.
void take(std::vector<double> coordinates, Drawn_object& object) {
  double farthest = 0;
  for (std::size_t v = 0; v < coordinates.size(); v += 3) {
    double steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      steps += std::abs(coordinates[v + axis] - object.coordinates[v + axis]);
    farthest = std::max(farthest, steps);
  }
  const double promised = 2 * farthest;
  if (object.is_promised && !std::isfinite(promised)) return;
  if (object.change(std::move(coordinates), object.given, object.placement) && object.is_promised)
    object.promise.move(promised);
}

}  // namespace

Triangle Drawn_object::triangle(std::size_t face) const {
  return face_triangle(faces[face], [this](std::uint32_t vertex) { return shown.data() + 3 * std::size_t{vertex}; });
}

bool Drawn_object::change(std::vector<double> coordinates_now, std::optional<std::vector<double>> given_now,
                          std::optional<Rigid_motion> placement_now) {
  const auto all_finite = [](const auto& list) {
    return std::ranges::all_of(list, [](double x) { return std::isfinite(x); });
  };
  // The mesh's own must stay finite, and so must what is placed of both: given coordinates can be taken back.
  const auto placed = [&](const std::vector<double>& from) {
    std::vector<double> memory = from;
    if (placement_now) (*placement_now)(Coordinates(from.data(), from.size()), memory);
    return memory;
  };
  auto of_mesh = placed(coordinates_now), of_given = given_now ? placed(*given_now) : of_mesh;
  if (!all_finite(coordinates_now) || !all_finite(of_mesh) || !all_finite(of_given)) return false;
  std::ranges::copy(coordinates_now, coordinates.begin());  // in place: the mesh refers to them
  given = std::move(given_now), placement = std::move(placement_now), shown = std::move(of_given);
  return true;
}

void draw_object(Byte_source& bytes, Drawn_object& object) {
  const auto size = [&] { return static_cast<std::uint32_t>(1 + bytes.below(4)); };
  switch (bytes.below(8)) {
    case 0:
      make_tetrahedron(object);
      break;
    case 1:
      make_box(object);
      break;
    case 2:
      make_cloth(bytes, 7, 7, object);
      break;
    case 3:
    case 4:
      make_cloth(bytes, size(), size(), object);
      break;
    default:
      make_soup(bytes, bytes.flag(), object);
  }
  place(bytes, object);
  object.make_mesh();
}

void move_vertices(Byte_source& bytes, Drawn_object& object, const Drawn_object& other) {
  auto moved = object.coordinates;
  const auto choice = bytes.below(8);
  const auto vertex = 3 * bytes.below(std::min<std::size_t>(object.vertices(), 256));
  const auto axis = bytes.below(3);
  if (choice == 0) {  // all, along one axis
    const double step = bytes.coordinate();
    for (std::size_t i = axis; i < moved.size(); i += 3) moved[i] += step;
  } else if (choice == 1) {  // onto a vertex of the other object
    const auto target = 3 * bytes.below(std::min<std::size_t>(other.vertices(), 256));
    for (std::size_t i = 0; i < 3; ++i) moved[vertex + i] = other.coordinates[target + i];
  } else if (choice == 2) {  // the least possible
    moved[vertex + axis] = std::nextafter(moved[vertex + axis], bytes.flag() ? HUGE_VAL : -HUGE_VAL);
  } else if (choice == 3) {  // all, by a factor
    const double factor = bytes.coordinate();
    for (double& coordinate : moved) coordinate *= factor;
  } else {
    for (std::size_t i = 0; i < 3; ++i) moved[vertex + i] = bytes.coordinate();
  }
  take(std::move(moved), object);
}

void collapse_face(Byte_source& bytes, Drawn_object& object) {
  const auto& corners = object.faces[bytes.below(std::min<std::size_t>(object.faces.size(), 256))];
  auto moved = object.coordinates;
  const std::size_t collapsed = bytes.flag() ? 2 : 1;
  for (std::size_t corner = 1; corner <= collapsed; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      moved[3 * std::size_t{corners[corner]} + axis] = moved[3 * std::size_t{corners[0]} + axis];
  take(std::move(moved), object);
}

std::vector<std::uint32_t> change_faces(Byte_source& bytes, Drawn_object& object) {
  std::vector<std::uint32_t> changed;
  const auto choice = bytes.below(4);
  const auto face = bytes.below(std::min<std::size_t>(object.faces.size(), 256));
  const auto vertex = [&] {
    return static_cast<std::uint32_t>(bytes.below(std::min<std::size_t>(object.vertices(), 256)));
  };
  if (choice == 0 && object.faces.size() > 1) {
    // The last face takes the place of one that is removed.
    object.faces[face] = object.faces.back();
    object.faces.pop_back();
    if (face < object.faces.size()) changed.push_back(static_cast<std::uint32_t>(face));
  } else if (choice == 1 && object.faces.size() < 200) {
    object.faces.push_back({vertex(), vertex(), vertex()});
  } else {
    object.faces[face][bytes.below(3)] = vertex();
    changed.push_back(static_cast<std::uint32_t>(face));
  }
  object.mesh->set_arrays(object.coordinates, object.faces);
  object.change(object.coordinates, {}, object.placement);
  return changed;
}

std::optional<Rigid_motion> draw_placement(Byte_source& bytes) {
  const Eigen::Vector3d axis(bytes.coordinate(), bytes.coordinate(), bytes.coordinate());
  const Eigen::Vector3d shift(bytes.coordinate(), bytes.coordinate(), bytes.coordinate());
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
  // A quarter turn about an axis, which maps a lattice onto itself, or any other turn.
  const double angle = bytes.flag() ? 2 * std::atan(1) : bytes.coordinate();
  const double length = axis.stableNorm();
  if (length > 0 && std::isfinite(length) && std::isfinite(angle))
    placement.linear() = Eigen::AngleAxisd(angle, axis / length).toRotationMatrix();
  placement.translation() = shift;
  std::optional<Rigid_motion> motion;
  accepts([&] { motion = make_rigid_motion(placement); });
  return motion;
}

}  // namespace lodestone::fuzz
