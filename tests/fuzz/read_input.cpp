// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/read_input.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/computed_motion.h"

namespace lodestone::fuzz {

namespace {

bool is_finite(const Point& p) { return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()); }

std::vector<std::uint32_t> all_below(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// One by one, the positions are those of `truth`.
void check_computed(Computed_motion& computed, std::size_t frame, const std::vector<Point>& truth) {
  require(computed.vertex_count() == truth.size(), "the computed motion has another number of vertices");
  computed.set_frame(frame);
  for (std::uint32_t v = 0; v < truth.size(); ++v) {
    const Eigen::Vector3d p = computed(v);
    require(Point(p.x(), p.y(), p.z()) == truth[v], "a computed position differs from the posed one");
  }
}

void check_frame(const Motion& motion, Computed_motion* computed, std::size_t frame, std::vector<Point>& positions) {
  motion.pose(frame, positions);
  require(std::ranges::all_of(positions, is_finite), "a position of a frame is not finite");
  if (computed != nullptr) check_computed(*computed, frame, positions);
}

/// The first frame as a mesh, too.
void check_animation(const Animation& animation, const std::string& name) {
  check_motion(animation.motion, animation.vertices);
  std::vector<Point> positions(animation.vertices);
  animation.motion.pose(0, positions);
  require(mesh_of(positions, animation.faces, name).mesh.is_valid(false), "an animation gives an invalid mesh");
}

}  // namespace

void check_mesh(const Mesh_file& file, const Mesh_file_options& options) {
  const auto& mesh = file.mesh;
  require(mesh.is_valid(false), "the mesh is invalid");
  require(mesh.number_of_faces() > 0 && mesh.number_of_faces() <= options.max_faces, "a wrong number of faces");
  require(file.file_vertex.size() == mesh.number_of_vertices(), "file_vertex does not fit the mesh");
  require(file.file_face.size() == mesh.number_of_faces(), "file_face does not fit the mesh");
  require(std::ranges::is_sorted(file.file_face), "file_face decreases");
  for (const auto vertex : file.file_vertex) require(vertex < file.file_vertices, "there is no such file vertex");
  for (const auto v : mesh.vertices()) require(is_finite(mesh.point(v)), "a coordinate of the mesh is not finite");
}

void check_motion(const Motion& motion, std::size_t vertices) {
  const std::size_t last = motion.frames == 0 ? 99 : motion.frames - 1;
  std::unique_ptr<Computed_motion> computed;
  if (motion.computed) computed = motion.computed(all_below(vertices));
  std::vector<Point> positions(vertices);
  for (const std::size_t frame : {std::size_t{0}, last / 2, last})
    accepts([&] { check_frame(motion, computed.get(), frame, positions); });
}

void read_as_mesh(Input input, const std::string& extension) {
  const auto file = scratch().write("input" + extension, input);
  const Mesh_file_options options{.max_faces = 100'000};
  accepts([&] { check_mesh(read_mesh(file, options), options); });
}

void read_as_animation(Input input, const std::string& extension) {
  read_as_mesh(input, extension);
  const auto file = scratch().path() / ("input" + extension);
  accepts([&] { check_animation(read_animation(file), file.string()); });
}

}  // namespace lodestone::fuzz
