// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/capsule_surface.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace lodestone {

namespace {

using Eigen::Vector3d;

/// The smooth union as a function of space.
class Smooth_union {
 public:
  Smooth_union(std::span<const Capsule> capsules, double rounding) : capsules_(capsules), rounding_(rounding) {}

  double operator()(const Vector3d& point) const {
    double sum = 0;
    for (const auto& capsule : capsules_) sum += std::exp(-capsule.distance(point) / rounding_);
    return sum > 0 ? -rounding_ * std::log(sum) : nearest(point);
  }
  Vector3d gradient(const Vector3d& point) const {
    const double step = 0.01 * rounding_;
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d along = step * Vector3d::Unit(axis);
      gradient[axis] = ((*this)(point + along) - (*this)(point - along)) / (2 * step);
    }
    return gradient;
  }
  /// Where Newton's method along the gradient ends: on the surface.
  Vector3d projected(Vector3d point) const {
    for (int step = 0; step < 3; ++step) {
      const Vector3d slope = gradient(point);
      point -= (*this)(point) / std::max(slope.squaredNorm(), 0.1) * slope;
    }
    return point;
  }

 private:
  /// Far from all capsules, where the exponentials underflow.
  double nearest(const Vector3d& point) const {
    double least = capsules_.front().distance(point);
    for (const auto& capsule : capsules_) least = std::min(least, capsule.distance(point));
    return least;
  }

  std::span<const Capsule> capsules_;
  double rounding_;
};

/// A regular grid around all capsules, with the values of the function at its points.
class Grid {
 public:
  Grid(std::span<const Capsule> capsules, const Smooth_union& function, double cell) : cell_(cell) {
    Vector3d low = capsules.front().from, high = low;
    for (const auto& capsule : capsules)
      for (const auto& [end, radius] :
           {std::pair(capsule.from, capsule.radius_from), {capsule.to, capsule.radius_to}}) {
        low = low.cwiseMin((end.array() - radius).matrix());
        high = high.cwiseMax((end.array() + radius).matrix());
      }
    // Off the capsules' own symmetries, so that few grid points lie on the surface.
    origin_ = low - cell * Vector3d(2.13, 2.29, 2.37);
    for (int axis = 0; axis < 3; ++axis)
      size_[axis] = static_cast<std::size_t>((high[axis] - origin_[axis]) / cell) + 4;
    for (std::size_t point = 0; point < size_[0] * size_[1] * size_[2]; ++point) {
      const double value = function(position(point));
      values_.push_back(value == 0 ? 1e-12 : value);
    }
  }

  std::size_t size(int axis) const { return size_[axis]; }
  std::size_t point(std::size_t x, std::size_t y, std::size_t z) const { return (z * size_[1] + y) * size_[0] + x; }
  Vector3d position(std::size_t point) const {
    const Vector3d steps(static_cast<double>(point % size_[0]), static_cast<double>(point / size_[0] % size_[1]),
                         static_cast<double>(point / size_[0] / size_[1]));
    return origin_ + cell_ * steps;
  }
  bool inside(std::size_t point) const { return values_[point] < 0; }
  /// Where a line between two grid points on different sides crosses the surface.
  Vector3d crossing(std::size_t a, std::size_t b) const {
    const double share = std::clamp(values_[a] / (values_[a] - values_[b]), 0.05, 0.95);
    return position(a) + share * (position(b) - position(a));
  }

 private:
  Vector3d origin_;
  double cell_;
  std::array<std::size_t, 3> size_;
  std::vector<double> values_;
};

class Marching_tetrahedra {
 public:
  explicit Marching_tetrahedra(const Grid& grid) : grid_(grid) {}

  Surface_mesh surface() {
    for (std::size_t z = 0; z + 1 < grid_.size(2); ++z)
      for (std::size_t y = 0; y + 1 < grid_.size(1); ++y)
        for (std::size_t x = 0; x + 1 < grid_.size(0); ++x) cut_cell(x, y, z);
    return std::move(mesh_);
  }

 private:
  /// Six tetrahedra around the diagonal of the cell: each goes from corner to corner along the three axes in turn. So
  /// neighbouring cells cut their common side in the same way.
  void cut_cell(std::size_t x, std::size_t y, std::size_t z) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      std::array<std::size_t, 3> at{x, y, z};
      std::array<std::size_t, 4> corners{grid_.point(x, y, z)};
      for (std::size_t i = 0; i < 3; ++i) {
        ++at[static_cast<std::size_t>(axes[i])];
        corners[i + 1] = grid_.point(at[0], at[1], at[2]);
      }
      cut(corners);
    } while (std::ranges::next_permutation(axes).found);
  }

  /// One triangle where one corner is alone on its side, two where two are.
  void cut(const std::array<std::size_t, 4>& corners) {
    std::vector<std::size_t> in, out;
    for (const auto corner : corners) (grid_.inside(corner) ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    const Vector3d outwards = mean(out) - mean(in);
    if (in.size() == 2) {
      const auto a = vertex(in[0], out[0]), b = vertex(in[0], out[1]), c = vertex(in[1], out[1]),
                 d = vertex(in[1], out[0]);
      add(a, b, c, outwards);
      add(a, c, d, outwards);
      return;
    }
    const auto& three = in.size() == 3 ? in : out;
    const auto alone = in.size() == 3 ? out[0] : in[0];
    add(vertex(alone, three[0]), vertex(alone, three[1]), vertex(alone, three[2]), outwards);
  }

  Vector3d mean(const std::vector<std::size_t>& points) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto point : points) sum += grid_.position(point);
    return sum / static_cast<double>(points.size());
  }
  Surface_mesh::Vertex_index vertex(std::size_t a, std::size_t b) {
    const auto [known, is_new] = vertices_.try_emplace(std::minmax(a, b));
    if (is_new) {
      const Vector3d p = grid_.crossing(known->first.first, known->first.second);
      known->second = mesh_.add_vertex(Point(p.x(), p.y(), p.z()));
    }
    return known->second;
  }
  void add(Surface_mesh::Vertex_index a, Surface_mesh::Vertex_index b, Surface_mesh::Vertex_index c,
           const Vector3d& outwards) {
    const auto normal = CGAL::cross_product(mesh_.point(b) - mesh_.point(a), mesh_.point(c) - mesh_.point(a));
    if (Vector3d(normal.x(), normal.y(), normal.z()).dot(outwards) < 0) std::swap(b, c);
    mesh_.add_face(a, b, c);
  }

  const Grid& grid_;
  Surface_mesh mesh_;
  std::map<std::pair<std::size_t, std::size_t>, Surface_mesh::Vertex_index> vertices_;
};

/// A closed surface has three edges for two faces.
void simplify(Surface_mesh& mesh, std::size_t faces) {
  CGAL::Surface_mesh_simplification::edge_collapse(
      mesh, CGAL::Surface_mesh_simplification::Count_stop_predicate<Surface_mesh>(3 * faces / 2 + 1));
  mesh.collect_garbage();
}

void smooth(Surface_mesh& mesh, const Smooth_union& function) {
  std::vector<Point> moved;
  for (const auto v : mesh.vertices()) {
    Vector3d sum = Vector3d::Zero();
    double neighbours = 0;
    for (const auto w : mesh.vertices_around_target(mesh.halfedge(v))) {
      sum += Vector3d(mesh.point(w).x(), mesh.point(w).y(), mesh.point(w).z());
      ++neighbours;
    }
    const Vector3d p = function.projected(sum / neighbours);
    moved.emplace_back(p.x(), p.y(), p.z());
  }
  std::ranges::copy(moved, mesh.points().begin());
}

}  // namespace

double Capsule::distance(const Vector3d& point) const {
  const Vector3d along = to - from;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
  return (point - from - share * along).norm() - (radius_from + share * (radius_to - radius_from));
}

Surface_mesh capsule_surface(std::span<const Capsule> capsules, const Capsule_surface_options& options) {
  const Smooth_union function(capsules, options.rounding);
  const Grid grid(capsules, function, options.cell);
  Surface_mesh mesh = Marching_tetrahedra(grid).surface();
  simplify(mesh, options.faces);
  for (std::size_t pass = 0; pass < options.smoothings; ++pass) smooth(mesh, function);
  return mesh;
}

}  // namespace lodestone
