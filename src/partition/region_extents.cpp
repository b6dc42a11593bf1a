// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_extents.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/detail/d_ary_heap.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <tuple>

namespace lodestone {

namespace {

constexpr double unreached_length = std::numeric_limits<double>::infinity();

/// Shortest paths within one region after the other: Dijkstra, with Boost's heap. The memory is kept, and only what a
/// search has written is cleared, so a search costs nothing for the vertices outside its region.
class Shortest_paths {
 public:
  explicit Shortest_paths(const Extent_input& input)
      : input_(input),
        distance_(num_vertices(input.graph), unreached_length),
        predecessor_(distance_.size()),
        place_in_heap_(distance_.size()),
        heap_(Distance_map(distance_.begin()), Place_map(place_in_heap_.begin())) {}
  Shortest_paths(const Shortest_paths&) = delete;  // the heap refers to the other members
  Shortest_paths& operator=(const Shortest_paths&) = delete;

  void search(std::uint32_t home);

  /// The vertices that the last search reached, its home first.
  std::span<const std::uint32_t> reached() const { return reached_; }
  double distance(std::uint32_t vertex) const { return distance_[vertex]; }
  /// From the home to `end`.
  std::vector<std::uint32_t> path_to(std::uint32_t end) const;

 private:
  template <class Iterator>
  using Map = boost::iterator_property_map<Iterator, boost::typed_identity_property_map<std::uint32_t>>;
  using Distance_map = Map<std::vector<double>::iterator>;
  using Place_map = Map<std::vector<std::uint32_t>::iterator>;

  const Extent_input& input_;
  std::vector<double> distance_;              ///< V; infinity: not reached
  std::vector<std::uint32_t> predecessor_;    ///< V
  std::vector<std::uint32_t> place_in_heap_;  ///< V
  boost::d_ary_heap_indirect<std::uint32_t, 4, Place_map, Distance_map, std::less<double>> heap_;
  std::vector<std::uint32_t> reached_;
};

void Shortest_paths::search(std::uint32_t home) {
  for (const auto v : reached_) distance_[v] = unreached_length;
  reached_.assign(1, home);
  distance_[home] = 0;
  predecessor_[home] = home;
  heap_.push(home);
  while (!heap_.empty()) {
    const std::uint32_t v = heap_.top();
    heap_.pop();
    const Eigen::Vector3d position = input_.position(v);
    for (const std::uint32_t w : neighbours(input_.graph, v)) {
      // Half of the neighbours are settled: no path by way of this vertex is shorter.
      if (distance_[w] <= distance_[v] || input_.labels[w] != input_.labels[home]) continue;
      const double distance = distance_[v] + (position - input_.position(w)).norm();
      if (!(distance < distance_[w])) continue;
      const bool is_new = distance_[w] == unreached_length;
      distance_[w] = distance;
      predecessor_[w] = v;
      if (is_new) {
        reached_.push_back(w);
        heap_.push(w);
      } else {
        heap_.update(w);
      }
    }
  }
}

std::vector<std::uint32_t> Shortest_paths::path_to(std::uint32_t end) const {
  std::vector<std::uint32_t> path{end};
  while (path.back() != reached_.front()) path.push_back(predecessor_[path.back()]);
  std::ranges::reverse(path);
  return path;
}

struct Tangent_frame {
  Eigen::Vector3d x, y;
};

Tangent_frame tangent_frame(const Eigen::Vector3d& normal, const Eigen::Vector3d& x_axis) {
  const double length = normal.stableNorm();
  const Eigen::Vector3d n = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::UnitZ();
  Eigen::Vector3d x = x_axis - x_axis.dot(n) * n;
  if (!(x.norm() > 1e-6 * x_axis.norm())) {
    Eigen::Index flattest = 0;
    n.cwiseAbs().minCoeff(&flattest);
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(flattest);
    x = axis - axis.dot(n) * n;
  }
  x.normalize();
  return {.x = x, .y = n.cross(x)};
}

/// The narrowest of four cones around a direction that contains an offset: 0 within 5.6 degrees, 3 within 45; 4: none.
/// The cones are slightly wider than that, so that rounding does not decide about an offset on the edge of a cone.
std::size_t cone(double along, double across) {
  constexpr std::array<double, 4> tangents{0.0985, 0.1989, 0.4142, 1.0};
  std::size_t narrowest = 0;
  while (narrowest < tangents.size() && !(across <= along * tangents[narrowest] * (1 + 1e-9))) ++narrowest;
  return along > 0 ? narrowest : tangents.size();
}

bool on_border(const Extent_input& input, std::uint32_t vertex) {
  if (input.open_border[vertex]) return true;
  return std::ranges::any_of(neighbours(input.graph, vertex),
                             [&](auto w) { return input.labels[w] != input.labels[vertex]; });
}

Border_path border_path(const Extent_input& input, const Shortest_paths& paths, std::uint32_t end) {
  const auto walk = paths.path_to(end);
  constexpr std::size_t chords = 4;
  Border_path path{.length = paths.distance(end)};
  for (std::size_t i = 0; i <= chords; ++i) {
    const std::uint32_t sample = walk[i * (walk.size() - 1) / chords];
    if (!path.samples.empty() && path.samples.back() == sample) continue;
    if (!path.samples.empty())
      path.sampled_length += (input.position(sample) - input.position(path.samples.back())).norm();
    path.samples.push_back(sample);
  }
  return path;
}

/// The end of a path in one direction.
struct End {
  std::uint32_t vertex = 0;
  std::size_t cone = 4;  ///< 4: there is no end
  double distance = 0;

  bool is_missing() const { return cone == 4; }
};

/// Calls `use` for each of the vertices and each direction in which it lies as seen from home, within 45 degrees: with
/// the direction, and with the vertex as an end in its narrowest cone.
template <class Use>
void for_each_direction(const Extent_input& input, const Shortest_paths& paths, const Tangent_frame& frame,
                        std::span<const std::uint32_t> vertices, const Use& use) {
  const std::uint32_t home = paths.reached().front();
  const Eigen::Vector3d origin = input.position(home);
  for (const auto v : vertices) {
    if (v == home) continue;
    const Eigen::Vector3d offset = input.position(v) - origin;
    const double x = offset.dot(frame.x), y = offset.dot(frame.y);
    // A vertex straight above or below home has no direction in the tangent plane.
    if (std::hypot(x, y) <= 1e-9 * offset.norm()) continue;
    const std::array<double, 4> along{x, -x, y, -y};
    for (std::size_t direction = 0; direction < 4; ++direction) {
      const std::size_t narrowest = cone(along[direction], std::abs(along[(direction + 2) % 4]));
      if (narrowest < 4) use(direction, End{.vertex = v, .cone = narrowest, .distance = paths.distance(v)});
    }
  }
}

/// Whether the region goes on in a direction, and what was found of its border lies beside: it runs round a tube.
bool goes_on(const End& border, const End& farthest) {
  return farthest.cone < border.cone && farthest.distance > 1.5 * border.distance;
}

/// In each direction the nearest border vertex within the narrowest cone that holds one, or where the region goes on,
/// the farthest vertex within the narrowest cone. In a region without a border: the farthest vertex within 45 degrees.
/// Of several the one of the lowest index.
std::array<End, 4> find_ends(const Extent_input& input, const Shortest_paths& paths, const Tangent_frame& frame) {
  std::vector<std::uint32_t> border;
  std::ranges::copy_if(paths.reached(), std::back_inserter(border), [&](auto v) { return on_border(input, v); });
  std::array<End, 4> ends, farthest;
  for_each_direction(input, paths, frame, border, [&](std::size_t direction, const End& end) {
    const End& best = ends[direction];
    if (std::tie(end.cone, end.distance, end.vertex) < std::tie(best.cone, best.distance, best.vertex))
      ends[direction] = end;
  });
  // Within the narrowest cone no border lies beside the direction, so most regions are not looked through.
  if (std::ranges::all_of(ends, [](const End& end) { return end.cone == 0; })) return ends;
  for_each_direction(input, paths, frame, paths.reached(), [&](std::size_t direction, const End& end) {
    const End& best = farthest[direction];
    const bool is_farther = std::tie(best.distance, end.vertex) < std::tie(end.distance, best.vertex);
    if (border.empty() || end.cone == best.cone ? is_farther : end.cone < best.cone) farthest[direction] = end;
  });
  for (std::size_t direction = 0; direction < 4; ++direction)
    if (goes_on(ends[direction], farthest[direction])) ends[direction] = farthest[direction];
  return ends;
}

Region_extent measure(const Extent_input& input, const Extent_start& start, Shortest_paths& paths) {
  paths.search(start.home);
  const auto ends = find_ends(input, paths, tangent_frame(start.normal, start.x_axis));
  Region_extent extent;
  for (std::size_t direction = 0; direction < 4; ++direction)
    if (!ends[direction].is_missing()) extent.paths[direction] = border_path(input, paths, ends[direction].vertex);
  return extent;
}

}  // namespace

double angle_to_axis(const Eigen::Vector3d& normal, const Eigen::Vector3d& needle) {
  const auto frame = tangent_frame(normal, Eigen::Vector3d::Zero());
  return -std::atan2(needle.dot(frame.y), needle.dot(frame.x));
}

std::vector<Region_extent> region_extents(const Extent_input& input, std::span<const Extent_start> starts,
                                          Workers& workers) {
  std::vector<std::unique_ptr<Shortest_paths>> paths(workers.count());
  std::vector<Region_extent> extents(starts.size());
  workers.run(starts.size(), [&](std::size_t region, std::size_t worker) {
    if (!paths[worker]) paths[worker] = std::make_unique<Shortest_paths>(input);
    extents[region] = measure(input, starts[region], *paths[worker]);
  });
  return extents;
}

}  // namespace lodestone
