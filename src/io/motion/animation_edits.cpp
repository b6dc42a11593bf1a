// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/animation_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "mesh/is_finite.h"

namespace lodestone {
namespace {

constexpr std::size_t most_subdivided_faces = 50'000'000;

using Edge_ends = std::pair<std::uint32_t, std::uint32_t>;

void need_faces(const Animation& animation) {
  if (animation.faces.empty()) throw Bad_argument("a point cache has no faces: give its mesh");
}

/// A motion that computes its vertices from the `count` vertices of `motion`.
template <class Compute>
Motion computed(Motion motion, std::size_t count, Compute compute) {
  return {.frames = motion.frames,
          .pose =
              [inner = std::move(motion.pose), count, compute](std::size_t frame, std::span<Point> positions) {
                std::vector<Point> original(count);
                inner(frame, original);
                compute(frame, original, positions);
              },
          .frames_per_second = motion.frames_per_second,
          .start = motion.start};
}

/// Kept vertices by the cube of a grid that they lie in.
class Kept_vertices {
 public:
  explicit Kept_vertices(double distance) : distance_(distance) {}

  /// The first kept vertex within the distance.
  std::optional<std::uint32_t> near(const Point& point) const {
    std::optional<std::uint32_t> first;
    for_each_neighbour(cube_of(point), [&](const std::vector<Kept>& cube) {
      for (const auto& [at, index] : cube)
        if (CGAL::squared_distance(at, point) <= distance_ * distance_ && (!first || index < *first)) first = index;
    });
    return first;
  }
  std::uint32_t add(const Point& point) {
    cubes_[cube_of(point)].push_back({point, count_});
    return count_++;
  }

 private:
  using Cube = std::array<double, 3>;
  struct Kept {
    Point at;
    std::uint32_t index;
  };

  /// With a distance of 0, every position is a cube of its own.
  Cube cube_of(const Point& p) const {
    if (distance_ == 0) return {p.x(), p.y(), p.z()};
    return {std::floor(p.x() / distance_), std::floor(p.y() / distance_), std::floor(p.z() / distance_)};
  }

  template <class Visit>
  void for_each_neighbour(const Cube& cube, const Visit& visit) const {
    const int reach = distance_ == 0 ? 0 : 1;
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z)
          if (const auto found = cubes_.find({cube[0] + x, cube[1] + y, cube[2] + z}); found != cubes_.end())
            visit(found->second);
  }

  double distance_;
  std::uint32_t count_ = 0;
  std::map<Cube, std::vector<Kept>> cubes_;
};

struct Weld {
  double distance;
  std::vector<std::uint32_t> kept;    ///< per vertex that is kept: its index before
  std::vector<std::uint32_t> target;  ///< per vertex before: its index, or that of the one which it joins

  /// The two vertices made one that are farthest apart in a frame, if they are farther apart than they may be.
  std::optional<Parted_vertices> parted(std::size_t frame, std::span<const Point> original) const {
    Parted_vertices parted{.frame = frame};
    double largest = 0;
    for (std::uint32_t vertex = 0; vertex < target.size(); ++vertex) {
      const auto at = kept[target[vertex]];
      if (at == vertex) continue;
      const Point &p = original[at], &q = original[vertex];
      const double apart = std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
      if (apart > parted.distance) parted = {frame, at, vertex, apart};
      for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
    }
    if (parted.distance > distance + 0x1p-21 * largest) return parted;
    return std::nullopt;
  }
};

/// Which vertices become one.
Weld weld(std::span<const Point> points, double distance) {
  Weld made{.distance = distance, .kept = {}, .target = {}};
  Kept_vertices kept(distance);
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex) {
    const auto near = kept.near(points[vertex]);
    made.target.push_back(near ? *near : kept.add(points[vertex]));
    if (!near) made.kept.push_back(vertex);
  }
  return made;
}

void drop_degenerate_faces(Animation& animation) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < animation.faces.size(); ++f) {
    const auto [a, b, c] = animation.faces[f];
    if (a == b || b == c || c == a) continue;
    animation.faces[kept] = animation.faces[f];
    animation.file_face[kept++] = animation.file_face[f];
  }
  if (kept == 0) throw Bad_argument("welding leaves no face");
  animation.faces.resize(kept);
  animation.file_face.resize(kept);
}

/// Finite for all finite points, unlike CGAL::midpoint.
Point middle_of(const Point& a, const Point& b) {
  return {std::midpoint(a.x(), b.x()), std::midpoint(a.y(), b.y()), std::midpoint(a.z(), b.z())};
}

/// Refuses at once what would otherwise take long before it fails.
void check_subdivided_faces(std::size_t faces, std::size_t times) {
  for (; times > 0 && faces <= most_subdivided_faces; --times) faces *= 4;
  if (faces > most_subdivided_faces)
    throw Bad_argument(fmt::format("subdivision gives more than {} faces", most_subdivided_faces));
}

Animation subdivided_once(Animation animation) {
  const auto count = static_cast<std::uint32_t>(animation.vertices);
  std::map<Edge_ends, std::uint32_t> middles;
  auto edges = std::make_shared<std::vector<Edge_ends>>();
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto ends = std::minmax(a, b);
    const auto [entry, is_new] = middles.try_emplace(ends, count + static_cast<std::uint32_t>(edges->size()));
    if (is_new) edges->push_back(ends);
    return entry->second;
  };
  std::vector<Corners> faces;
  std::vector<std::uint32_t> file_face;
  for (std::size_t f = 0; f < animation.faces.size(); ++f) {
    const auto [a, b, c] = animation.faces[f];
    const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    file_face.insert(file_face.end(), 4, animation.file_face[f]);
  }
  animation.faces = std::move(faces);
  animation.file_face = std::move(file_face);
  animation.vertices = count + edges->size();
  animation.motion = computed(std::move(animation.motion), count,
                              [edges](std::size_t, const std::vector<Point>& original, std::span<Point> positions) {
                                auto next = std::ranges::copy(original, positions.begin()).out;
                                for (const auto& [a, b] : *edges) *next++ = middle_of(original[a], original[b]);
                              });
  return animation;
}

}  // namespace

Animation scaled(Animation animation, double factor) {
  if (!(factor > 0) || !std::isfinite(factor))
    throw Bad_argument(fmt::format("the scale is {}, must be > 0 and finite", factor));
  animation.motion =
      computed(std::move(animation.motion), animation.vertices,
               [factor](std::size_t, const std::vector<Point>& original, std::span<Point> positions) {
                 for (std::size_t v = 0; v < original.size(); ++v) {
                   positions[v] = CGAL::ORIGIN + factor * (original[v] - CGAL::ORIGIN);
                   if (!is_finite(positions[v]))
                     throw Bad_motion(fmt::format("vertex {} is not finite after scaling by {}", v, factor));
                 }
               });
  return animation;
}

Animation welded(Animation animation, double distance, std::function<void(const Parted_vertices&)> parted) {
  if (!(distance >= 0) || !std::isfinite(distance))
    throw Bad_argument(fmt::format("the distance to weld is {}, must be >= 0 and finite", distance));
  need_faces(animation);
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(0, points);
  const auto joins = std::make_shared<const Weld>(weld(points, distance));
  for (auto& face : animation.faces)
    for (auto& corner : face) corner = joins->target[corner];
  drop_degenerate_faces(animation);
  animation.motion = computed(std::move(animation.motion), animation.vertices,
                              [joins, parted = std::move(parted)](std::size_t frame, const std::vector<Point>& original,
                                                                  std::span<Point> positions) {
                                for (std::size_t v = 0; v < joins->kept.size(); ++v)
                                  positions[v] = original[joins->kept[v]];
                                if (!parted) return;
                                if (const auto vertices = joins->parted(frame, original)) parted(*vertices);
                              });
  animation.vertices = joins->kept.size();
  return animation;
}

Animation subdivided(Animation animation, std::size_t times) {
  if (times == 0) return animation;
  need_faces(animation);
  check_subdivided_faces(animation.faces.size(), times);
  for (; times > 0; --times) animation = subdivided_once(std::move(animation));
  return animation;
}

}  // namespace lodestone
