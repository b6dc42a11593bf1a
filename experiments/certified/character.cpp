// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/character.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/scenes/given_objects.h"

namespace lodestone {

namespace {

using Vertex_index = Surface_mesh::Vertex_index;

/// A fine vertex as a mean of old ones.
struct Mean {
  std::array<std::uint32_t, 3> of{};
  std::array<double, 3> shares{};
  std::size_t count = 0;

  void add(std::uint32_t vertex, double share) {
    of[count] = vertex;
    shares[count++] = share;
  }
};

/// A mesh whose faces are cut: its faces, and what its vertices are means of. The old vertices come first.
class Cut_faces {
 public:
  Cut_faces(std::span<const Corners> corners, std::size_t vertices, std::size_t parts)
      : parts_(static_cast<std::uint32_t>(parts)) {
    for (std::uint32_t v = 0; v < vertices; ++v) {
      means.emplace_back().add(v, 1);
    }
    faces.reserve(corners.size() * parts * parts);
    for (const auto& face : corners) cut(face);
  }

  std::vector<Mean> means;
  std::vector<Corners> faces;

 private:
  /// Rows of vertices from the first corner to the side opposite to it, and two triangles between each two neighbours.
  void cut(const Corners& face) {
    std::vector<std::vector<std::uint32_t>> rows(parts_ + 1);
    for (std::uint32_t row = 0; row <= parts_; ++row)
      for (std::uint32_t place = 0; place <= row; ++place) rows[row].push_back(vertex(face, row, place));
    for (std::uint32_t row = 0; row < parts_; ++row)
      for (std::uint32_t place = 0; place <= row; ++place) {
        faces.push_back({rows[row][place], rows[row + 1][place], rows[row + 1][place + 1]});
        if (place < row) faces.push_back({rows[row][place], rows[row + 1][place + 1], rows[row][place + 1]});
      }
  }

  /// @param row    away from the first corner
  /// @param place  in the row, from the side of the second corner to that of the third
  std::uint32_t vertex(const Corners& face, std::uint32_t row, std::uint32_t place) {
    const auto [a, b, c] = face;
    if (place == 0) return on_edge(a, b, row);
    if (place == row) return on_edge(a, c, row);
    if (row == parts_) return on_edge(b, c, place);
    Mean& mean = means.emplace_back();
    mean.add(a, share(parts_ - row));
    mean.add(b, share(row - place));
    mean.add(c, share(place));
    return static_cast<std::uint32_t>(means.size() - 1);
  }
  std::uint32_t on_edge(std::uint32_t from, std::uint32_t to, std::uint32_t step) {
    if (step == 0) return from;
    if (step == parts_) return to;
    if (from > to) return on_edge(to, from, parts_ - step);  // both faces of an edge must find the same vertices
    const auto [known, is_new] = edges_.try_emplace({from, to}, static_cast<std::uint32_t>(means.size()));
    if (is_new)
      for (std::uint32_t i = 1; i < parts_; ++i) {
        Mean& mean = means.emplace_back();
        mean.add(from, share(parts_ - i));
        mean.add(to, share(i));
      }
    return known->second + step - 1;
  }
  double share(std::uint32_t steps) const { return static_cast<double>(steps) / parts_; }

  std::uint32_t parts_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges_;  ///< the first vertex on each
};

std::vector<double> mean_positions(std::span<const double> rest, const std::vector<Mean>& means) {
  std::vector<double> positions;
  positions.reserve(3 * means.size());
  for (const auto& mean : means)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t i = 0; i < mean.count; ++i) sum += mean.shares[i] * rest[3 * std::size_t{mean.of[i]} + axis];
      positions.push_back(sum);
    }
  return positions;
}

Joint_influences mean_influences(const Skinned_points& points, const std::vector<Mean>& means) {
  Joint_influences influences;
  std::map<std::uint32_t, double> weights;
  for (const auto& mean : means) {
    weights.clear();
    for (std::size_t i = 0; i < mean.count; ++i) {
      const auto old = points.influences(mean.of[i]);
      for (std::size_t k = 0; k < old.joints.size(); ++k) weights[old.joints[k]] += mean.shares[i] * old.weights[k];
    }
    for (const auto& [joint, weight] : weights) {
      influences.joints.push_back(joint);
      influences.weights.push_back(weight);
    }
    influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
  }
  return influences;
}

std::vector<Morph_target> mean_targets(const Morphed_points& shape, const std::vector<Mean>& means) {
  std::vector<Morph_target> targets(shape.target_count());
  std::vector<Eigen::Vector3d> offsets(targets.size());
  for (std::uint32_t v = 0; v < means.size(); ++v) {
    std::ranges::fill(offsets, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < means[v].count; ++i)
      shape.for_each_offset(means[v].of[i], [&](std::uint32_t target, std::span<const double, 3> offset) {
        offsets[target] += means[v].shares[i] * Eigen::Vector3d(offset[0], offset[1], offset[2]);
      });
    for (std::size_t target = 0; target < targets.size(); ++target) {
      if (offsets[target].isZero(0)) continue;
      targets[target].vertices.push_back(v);
      targets[target].offsets.insert(targets[target].offsets.end(), offsets[target].begin(), offsets[target].end());
    }
  }
  return targets;
}

Surface_mesh mesh_of(const std::vector<double>& positions, const std::vector<Corners>& faces) {
  Surface_mesh mesh;
  const auto vertices = static_cast<Surface_mesh::size_type>(positions.size() / 3);
  const auto count = static_cast<Surface_mesh::size_type>(faces.size());
  mesh.reserve(vertices, 3 * count / 2, count);
  for (std::size_t i = 0; i < positions.size(); i += 3)
    mesh.add_vertex(Point(positions[i], positions[i + 1], positions[i + 2]));
  for (const auto& [a, b, c] : faces) mesh.add_face(Vertex_index(a), Vertex_index(b), Vertex_index(c));
  return mesh;
}

}  // namespace

Skin_pose Skin_pose::of(const Skinned_points& points) {
  Skin_pose pose;
  for (std::uint32_t joint = 0; joint < points.joint_count(); ++joint) {
    const Eigen::Map<const Eigen::Matrix4d> columns(points.columns(joint));
    pose.joints.emplace_back().affine() = columns.topRows<3>();
  }
  pose.weights.assign(points.shape().weights().begin(), points.shape().weights().end());
  return pose;
}

Skin_pose Skin_pose::placed(const Eigen::Affine3d& placement) const {
  Skin_pose moved = *this;
  for (auto& joint : moved.joints) joint = placement * joint;
  return moved;
}

void Skin_pose::give_to(Skinned_points& points) const {
  points.set_joints(joints);
  if (!weights.empty()) points.set_weights(weights);
}

std::optional<Character> read_character(const std::filesystem::path& file) {
  Scene_object object = read_object(file.stem().string(), file);
  if (!object.motion.computed || object.motion.frames < 2) return std::nullopt;
  const auto motion = object.motion.computed(object.file_vertex);
  if (motion->skin() == nullptr) return std::nullopt;
  Character character{.name = object.name, .mesh = std::move(object.mesh), .points = *motion->skin()};
  for (std::size_t frame = 0; frame < object.motion.frames; ++frame) {
    motion->set_frame(frame);
    character.animation.push_back(Skin_pose::of(*motion->skin()));
  }
  return character;
}

Character subdivided(const Character& character, std::size_t parts) {
  const Mesh_numbering<Surface_mesh> numbering(character.mesh);
  const Cut_faces cut(numbering.corners(), numbering.vertex_count(), parts);
  auto positions = mean_positions(character.points.shape().rest(), cut.means);
  const auto targets = mean_targets(character.points.shape(), cut.means);
  auto mesh = mesh_of(positions, cut.faces);
  return {.name = character.name,
          .mesh = std::move(mesh),
          .points = Skinned_points(Morphed_points(std::move(positions), targets),
                                   mean_influences(character.points, cut.means), character.points.joint_count())};
}

std::size_t parts_for(const Character& character, std::size_t faces) {
  const double coarse = static_cast<double>(character.mesh.number_of_faces());
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(faces) / coarse) + 0.5));
}

}  // namespace lodestone
