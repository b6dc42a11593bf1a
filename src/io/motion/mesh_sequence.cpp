// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/mesh_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "io/files/small_text.h"
#include "io/meshes/read_mesh_soup.h"
#include "io/motion/check_frames.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

using Faces = std::vector<std::vector<std::size_t>>;

/// Faces as the file lists them: the triangles of a polygon depend on its shape, which changes from frame to frame.
Polygon_soup read_frame(const std::filesystem::path& file, const Mesh_file_options& limits) {
  try {
    return read_polygon_soup(file, limits);
  } catch (const Bad_mesh& error) {
    throw Bad_motion(error.what());
  }
}

/// The properties of the first frame that all others must share.
struct First_frame {
  std::filesystem::path file;
  Faces faces;
  bool joins = false;  ///< whether the reader has joined vertices
};

void check_face_count(const std::filesystem::path& file, const Faces& faces, const First_frame& first) {
  if (faces.size() != first.faces.size())
    throw Bad_motion(fmt::format("{}: the mesh has {} faces, {} has {}", file.string(), faces.size(),
                                 first.file.string(), first.faces.size()));
}

void check_same_faces(const std::filesystem::path& file, const Polygon_soup& posed, const First_frame& first) {
  check_face_count(file, posed.faces, first);
  const auto differing = std::ranges::mismatch(posed.faces, first.faces).in1;
  if (differing == posed.faces.end()) return;
  const bool joins = first.joins || !posed.joined.empty();
  throw Bad_motion(fmt::format("{}: face {} (counted from 0) has other corners than in {}{}", file.string(),
                               differing - posed.faces.begin(), first.file.string(),
                               joins ? ": in each of these files, vertices that are alike are joined" : ""));
}

void check_vertices(const std::filesystem::path& file, std::size_t found, std::size_t expected) {
  if (found != expected)
    throw Bad_motion(fmt::format("{}: the mesh has {} vertices, expected {}", file.string(), found, expected));
}

bool is_stl(const std::filesystem::path& file) { return lower_case(file.extension().string()) == ".stl"; }

/// Takes positions from the corners of the faces. STL files have no numbers for vertices: corners at one place are one
/// vertex, and in some frames other vertices may come to be there too.
void pose_by_corners(const std::filesystem::path& file, const Polygon_soup& posed, const First_frame& first,
                     std::span<Point> positions) {
  check_face_count(file, posed.faces, first);
  std::vector<bool> is_posed(positions.size(), false);
  for (std::size_t face = 0; face < posed.faces.size(); ++face)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t vertex = first.faces[face][corner];
      const Point& here = posed.points[posed.faces[face][corner]];
      if (is_posed[vertex] && positions[vertex] != here)
        throw Bad_motion(
            fmt::format("{}: corner {} of face {} (counted from 0) is not where the others of its vertex are: they "
                        "are at one place in {}",
                        file.string(), corner, face, first.file.string()));
      positions[vertex] = here;
      is_posed[vertex] = true;
    }
}

void check_files(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) throw Bad_motion("a sequence of mesh files needs at least one file, found none");
  std::error_code ignored;
  for (const auto& file : files)
    if (!exists(file, ignored)) throw Bad_motion(fmt::format("{}: there is no such file", file.string()));
}

std::size_t first_of(const Joined_vertices& joined, std::size_t vertex) {
  return joined.empty() ? vertex : joined[vertex];
}

/// Each vertex once, ascending.
std::vector<std::size_t> as_set(std::vector<std::size_t> vertices) {
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Compares faces one after the other. Where one has more triangles than that of the other file, the next ones there
/// must be its parts: have as many triangles, and the same vertices. O(n log n) in the corners of all faces.
/// @return the first of `faces` that differs; none if all are the same
std::optional<std::size_t> first_other(const std::vector<Face_corners>& faces,
                                       const std::vector<Face_corners>& others) {
  std::size_t face = 0, other = 0;
  while (face < faces.size() && other < others.size()) {
    const bool is_whole = faces[face].triangles >= others[other].triangles;
    const Face_corners& whole = is_whole ? faces[face] : others[other];
    const auto& parts = is_whole ? others : faces;
    std::size_t &at = is_whole ? other : face, left = whole.triangles;
    const std::size_t found = face;
    std::vector<std::size_t> of_parts;
    for (; left > 0; left -= parts[at++].triangles) {
      if (at == parts.size() || parts[at].triangles > left) return found;
      of_parts.insert(of_parts.end(), parts[at].vertices.begin(), parts[at].vertices.end());
    }
    if (as_set(std::move(of_parts)) != as_set(whole.vertices)) return found;
    ++(is_whole ? face : other);
  }
  if (face == faces.size() && other == others.size()) return std::nullopt;
  return std::min(face, faces.size() - 1);
}

}  // namespace

void check_faces_of_file(const std::filesystem::path& file, const Moved_faces& moved, const Mesh_file_options& limits) {
  const Polygon_soup soup = read_frame(file, limits);
  const auto joined = [&](std::vector<Face_corners> faces) {
    for (auto& face : faces)
      for (auto& vertex : face.vertices) vertex = first_of(moved.joined, first_of(soup.joined, vertex));
    return faces;
  };
  std::vector<Face_corners> faces;
  for (const auto& face : soup.faces) faces.push_back({face.size() - 2, face});
  if (const auto other = first_other(joined(std::move(faces)), joined(moved.faces)))
    throw Bad_motion(fmt::format("{}: face {} (counted from 0) has other corners than in {}", file.string(), *other,
                                 moved.mesh.empty() ? "the shape" : moved.mesh.string()));
}

Motion read_mesh_sequence(std::vector<std::filesystem::path> files, std::size_t vertices,
                          const Mesh_file_options& limits) {
  check_files(files);
  check_frames(files.front().string(), files.size(), limits);
  auto soup = read_frame(files.front(), limits);
  check_vertices(files.front(), soup.points.size(), vertices);
  const auto first = std::make_shared<const First_frame>(
      First_frame{.file = files.front(), .faces = std::move(soup.faces), .joins = !soup.joined.empty()});

  const auto frames = files.size();
  const auto pose = [files = std::move(files), first, vertices, limits](std::size_t frame, std::span<Point> positions) {
    if (frame >= files.size())
      throw Bad_motion(fmt::format("{}: frame {} (counted from 0) is requested, the sequence has {}",
                                   first->file.string(), frame, files.size()));
    const auto posed = read_frame(files[frame], limits);
    check_vertices(files[frame], vertices, positions.size());
    if (is_stl(first->file) && is_stl(files[frame])) return pose_by_corners(files[frame], posed, *first, positions);
    check_vertices(files[frame], posed.points.size(), vertices);
    check_same_faces(files[frame], posed, *first);
    std::ranges::copy(posed.points, positions.begin());
  };
  return {.frames = frames, .pose = pose};
}

}  // namespace lodestone
