// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/unset_vector.h"

namespace lodestone {
namespace {

/// The keys before and after a time, and its position between them.
struct Between {
  std::size_t before = 0, after = 0;
  double part = 0;     ///< 0 to 1
  double seconds = 0;  ///< from key to key
};

/// The curve is constant before the first key and after the last.
Between between(const std::vector<double>& times, double time) {
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (next == 0) return {};
  if (next == times.size()) return {.before = next - 1, .after = next - 1};
  const double seconds = times[next] - times[next - 1];
  return {.before = next - 1, .after = next, .part = (time - times[next - 1]) / seconds, .seconds = seconds};
}

double cubic(double from, double leaving, double to, double arriving, double part, double seconds) {
  const double t = part, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * from + seconds * (t3 - 2 * t2 + t) * leaving + (3 * t2 - 2 * t3) * to +
         seconds * (t3 - t2) * arriving;
}

/// Samples each number of the curve independently. The caller must normalise a rotation afterwards.
void sample(const Gltf_curve& curve, double time, std::vector<double>& value) {
  const auto [before, after, part, seconds] = between(curve.times, time);
  value.resize(curve.width);
  const bool is_cubic = curve.interpolation == Gltf_interpolation::cubic;
  const auto number = [&](std::size_t key, std::size_t kind, std::size_t k) {
    return curve.values[((is_cubic ? 3 * key + kind : key) * curve.width) + k];
  };
  constexpr std::size_t arriving = 0, leaving = 2;
  const std::size_t here = is_cubic ? 1 : 0;
  for (std::size_t k = 0; k < curve.width; ++k) {
    const double from = number(before, here, k);
    if (before == after || curve.interpolation == Gltf_interpolation::step)
      value[k] = from;
    else if (is_cubic)
      value[k] =
          cubic(from, number(before, leaving, k), number(after, here, k), number(after, arriving, k), part, seconds);
    else
      value[k] = (1 - part) * from + part * number(after, here, k);
  }
}

Eigen::Quaterniond quaternion(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

Eigen::Quaterniond unit(Eigen::Quaterniond rotation, const Gltf_scene& scene, std::size_t node) {
  const double length = rotation.norm();
  if (!(length > 0) || !std::isfinite(length))
    throw Bad_motion(fmt::format("{}: /nodes/{}: a rotation of the animation has no direction", scene.name, node));
  rotation.coeffs() /= length;
  return rotation;
}

/// Linear curves rotate at constant speed, the shorter way round.
Eigen::Quaterniond sample_rotation(const Gltf_curve& curve, double time, const Gltf_scene& scene) {
  if (curve.interpolation == Gltf_interpolation::linear) {
    const auto keys = between(curve.times, time);
    const auto from = unit(quaternion(curve.values.data() + 4 * keys.before), scene, curve.node);
    const auto to = unit(quaternion(curve.values.data() + 4 * keys.after), scene, curve.node);
    return from.slerp(keys.part, to);
  }
  std::vector<double> value;
  sample(curve, time, value);
  return unit(quaternion(value.data()), scene, curve.node);
}

/// The state of each node at one time of the animation.
struct Posed_nodes {
  std::vector<Eigen::Affine3d> to_world;
  std::vector<std::vector<double>> weights;  ///< of morph targets; empty: rest weights
};

Eigen::Affine3d transformation(const Gltf_place& place) {
  if (place.matrix) return *place.matrix;
  return Eigen::Translation3d(place.translation) * place.rotation * Eigen::Scaling(place.scale);
}

Posed_nodes pose_nodes(const Gltf_scene& scene, const Gltf_animation* animation, double time) {
  const auto count = scene.nodes.size();
  std::vector<Gltf_place> places;
  places.reserve(count);
  Posed_nodes posed{.to_world = std::vector<Eigen::Affine3d>(count), .weights = {}};
  for (const auto& node : scene.nodes) {
    places.push_back(node.place);
    posed.weights.push_back(node.weights);
  }
  std::vector<double> value;
  const auto curves = animation ? std::span(animation->curves) : std::span<const Gltf_curve>();
  for (const auto& curve : curves) {
    auto& place = places[curve.node];
    if (curve.path == Gltf_path::rotation) {
      place.rotation = sample_rotation(curve, time, scene);
      continue;
    }
    sample(curve, time, value);
    if (curve.path == Gltf_path::weights)
      posed.weights[curve.node] = value;
    else
      (curve.path == Gltf_path::scale ? place.scale : place.translation) =
          Eigen::Vector3d(value[0], value[1], value[2]);
  }
  for (const auto node : scene.order) {
    posed.to_world[node] = transformation(places[node]);
    if (const auto parent = scene.nodes[node].parent; parent != no_index)
      posed.to_world[node] = posed.to_world[parent] * posed.to_world[node];
  }
  return posed;
}

std::vector<Eigen::Affine3d> joint_motions(const Gltf_skin& skin, const Posed_nodes& posed) {
  std::vector<Eigen::Affine3d> motions;
  motions.reserve(skin.joints.size());
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint)
    motions.push_back(posed.to_world[skin.joints[joint]] * skin.from_mesh[joint]);
  return motions;
}

/// Where the joints and targets of each part start among those of all. Parts with the same skin share its joints.
struct Part_ranges {
  std::vector<std::uint32_t> first_joint = {}, first_target = {0};
  std::uint32_t joint_count = 0;

  explicit Part_ranges(const Gltf_scene& scene) {
    std::vector<std::optional<std::uint32_t>> first_of_skin(scene.skins.size());
    for (const auto& part : scene.parts) {
      if (part.skin == no_index) {
        first_joint.push_back(add_joints(1));
      } else {
        auto& first = first_of_skin[part.skin];
        if (!first) first = add_joints(scene.skins[part.skin].joints.size());
        first_joint.push_back(*first);
      }
      first_target.push_back(first_target.back() + static_cast<std::uint32_t>(part.shape->targets.size()));
    }
  }

 private:
  std::uint32_t add_joints(std::size_t count) {
    return std::exchange(joint_count, joint_count + static_cast<std::uint32_t>(count));
  }
};

/// Gathers what is known of single vertices of all parts.
class Gathering {
 public:
  Gathering(const Gltf_scene& scene, std::span<const std::uint32_t> vertices)
      : scene_(scene), ranges_(scene), targets_(ranges_.first_target.back()) {
    for (std::uint32_t i = 0; i < vertices.size(); ++i) add(i, vertices[i]);
  }

  Skinned_points points() && { return {Morphed_points(std::move(rest_), targets_), influences_, ranges_.joint_count}; }

 private:
  /// @param i       index among the points
  /// @param vertex  index in the scene
  void add(std::uint32_t i, std::uint32_t vertex) {
    const auto after = std::ranges::upper_bound(scene_.parts, vertex, {}, &Gltf_part::first_vertex);
    const auto number = static_cast<std::size_t>(after - scene_.parts.begin()) - 1;
    const Gltf_part& part = scene_.parts[number];
    const std::size_t v = vertex - part.first_vertex;
    const double* at = part.shape->positions.data() + 3 * v;
    rest_.insert(rest_.end(), at, at + 3);
    add_influences(part, v, ranges_.first_joint[number]);
    for (std::size_t target = 0; target < part.shape->targets.size(); ++target) {
      const Coordinate_list& offsets = part.shape->targets[target];
      if (offsets.empty()) continue;
      Morph_target& gathered = targets_[ranges_.first_target[number] + target];
      gathered.vertices.push_back(i);
      gathered.offsets.insert(gathered.offsets.end(), offsets.data() + 3 * v, offsets.data() + 3 * v + 3);
    }
  }

  /// A mesh with a skin follows only its joints, not its node; one without follows its node as its only joint.
  void add_influences(const Gltf_part& part, std::size_t v, std::uint32_t first_joint) {
    if (part.skin == no_index) {
      influences_.joints.push_back(first_joint);
      influences_.weights.push_back(1);
    }
    for (std::size_t k = v * part.shape->influences; part.skin != no_index && k < (v + 1) * part.shape->influences; ++k)
      if (part.shape->joint_weights[k] != 0) {
        influences_.joints.push_back(first_joint + part.shape->joints[k]);
        influences_.weights.push_back(part.shape->joint_weights[k]);
      }
    influences_.begin.push_back(static_cast<std::uint32_t>(influences_.joints.size()));
  }

  const Gltf_scene& scene_;
  Part_ranges ranges_;
  std::vector<double> rest_;
  std::vector<Morph_target> targets_;
  Joint_influences influences_;
};

}  // namespace

Gltf_points::Gltf_points(std::shared_ptr<const Gltf_scene> scene, std::span<const std::uint32_t> vertices)
    : scene_(std::move(scene)),
      first_joints_(Part_ranges(*scene_).first_joint),
      points_(Gathering(*scene_, vertices).points()) {
  set_time(nullptr, 0);
}

void Gltf_points::set_time(const Gltf_animation* animation, double time) {
  const auto posed = pose_nodes(*scene_, animation, time);
  std::vector<double> weights;
  std::vector<Eigen::Affine3d> joints;
  for (std::size_t number = 0; number < scene_->parts.size(); ++number) {
    const Gltf_part& part = scene_->parts[number];
    const auto& own = posed.weights[part.node].empty() ? part.shape->weights : posed.weights[part.node];
    weights.insert(weights.end(), own.begin(), own.end());
    if (first_joints_[number] < joints.size()) continue;  // an earlier part has the same skin
    if (part.skin == no_index) {
      joints.push_back(posed.to_world[part.node]);
    } else {
      const auto of_skin = joint_motions(scene_->skins[part.skin], posed);
      joints.insert(joints.end(), of_skin.begin(), of_skin.end());
    }
  }
  try {
    points_.set_weights(weights);
    points_.set_joints(joints);
  } catch (const Bad_argument& error) {
    throw Bad_motion(fmt::format("{}: {}", scene_->name, error.what()));
  }
}

std::vector<std::uint32_t> all_vertices(const Gltf_scene& scene) {
  std::vector<std::uint32_t> all(scene.vertices);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

void pose_all(const Gltf_points& points, const std::string& name, std::span<Point> positions) {
  Unset_vector<double> coordinates(3 * positions.size());
  points.points().pose_all(coordinates);
  for (std::size_t vertex = 0; vertex < positions.size(); ++vertex) {
    const double* p = coordinates.data() + 3 * vertex;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw Bad_motion(
          fmt::format("{}: vertex {} (counted from 0) is moved to a position that is not finite", name, vertex));
    positions[vertex] = Point(p[0], p[1], p[2]);
  }
}

}  // namespace lodestone
