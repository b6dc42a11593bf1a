// SPDX-License-Identifier: GPL-3.0-or-later
// What benchmarks of rays and points have in common: a mesh that has moved, and questions that libraries take turns in.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/tree/tree_surface.h"
#include "shared/lap_timer.h"

namespace lodestone {

/// The index of no face.
inline constexpr std::uint32_t no_face = ~std::uint32_t{0};

/// A sphere with waves on it, which move.
struct Wavy_sphere {
  Surface_mesh mesh;
  std::vector<Corners> corners;
  std::vector<double> coordinates;
  Tree_surface tree;

  explicit Wavy_sphere(std::size_t frequency) : mesh(icosphere(frequency)) {
    corners = Mesh_numbering<Surface_mesh>(mesh).corners();
    rest_.reserve(3 * mesh.number_of_vertices());
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      rest_.insert(rest_.end(), {p.x(), p.y(), p.z()});
    }
    coordinates = rest_;
    tree = Tree_surface(corners, coordinates);
    move(1);
  }

  void move(double time) {
    for (const auto v : mesh.vertices()) {
      const Eigen::Map<const Eigen::Vector3d> p(rest_.data() + 3 * std::size_t{v});
      const Eigen::Vector3d moved = (1 + 0.1 * std::sin(5 * p.x() + time) * std::sin(7 * p.y())) * p;
      mesh.point(v) = Point(moved.x(), moved.y(), moved.z());
      for (int axis = 0; axis < 3; ++axis)
        coordinates[3 * std::size_t{v} + static_cast<std::size_t>(axis)] = moved[axis];
    }
    Tree_surface* const trees[]{&tree};
    const Coordinates now[]{coordinates};
    refit(trees, now, Workers::alone());
  }

 private:
  std::vector<double> rest_;
};

/// Answers that differ.
inline std::size_t differences(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

/// Nanoseconds per question of one library, pass by pass, and its last answers.
struct Answers {
  std::vector<double> nanoseconds = {};
  std::vector<std::uint32_t> faces = {};

  template <class Questions, class Answer>
  void ask(const Questions& questions, const Answer& answer) {
    faces.resize(questions.size());
    Lap_timer timer;
    for (std::size_t i = 0; i < questions.size(); ++i) faces[i] = answer(questions[i]);
    nanoseconds.push_back(1e9 * timer.lap() / static_cast<double>(questions.size()));
  }
  /// The same for all questions in one call.
  /// @param answer  returns the faces
  template <class Questions, class Answer>
  void ask_at_once(const Questions& questions, const Answer& answer) {
    Lap_timer timer;
    faces = answer(questions);
    nanoseconds.push_back(1e9 * timer.lap() / static_cast<double>(questions.size()));
  }
  double least() const { return *std::ranges::min_element(nanoseconds); }
};

}  // namespace lodestone
