// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/meshes/read_mesh_soup.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/files/small_text.h"
#include "io/formats/game_model.h"
#include "io/formats/mesh_guard.h"
#include "io/gltf/gltf_scene.h"
#include "io/meshes/triangulated_soup.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

// Some of CGAL's readers print their errors by default.
const auto silent = CGAL::parameters::verbose(false);

// Surface_mesh and CGAL's readers use 32-bit indices; a triangle has up to 6 half-edges.
constexpr std::size_t most_vertices = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t most_triangles = most_vertices / 6;

struct Mesh_format {
  std::string_view extension;
  Guarded_mesh (*guard)(const File_bytes&, std::size_t max_faces);
  bool (*read)(std::istream&, Polygon_soup&);
};

constexpr std::array<Mesh_format, 4> formats = {{
    {".off", guard_off,
     [](std::istream& in, Polygon_soup& soup) { return CGAL::IO::read_OFF(in, soup.points, soup.faces, silent); }},
    {".obj", guard_obj,
     [](std::istream& in, Polygon_soup& soup) { return CGAL::IO::read_OBJ(in, soup.points, soup.faces, silent); }},
    {".ply", guard_ply,
     [](std::istream& in, Polygon_soup& soup) { return CGAL::IO::read_PLY(in, soup.points, soup.faces, silent); }},
    {".stl", guard_stl,
     [](std::istream& in, Polygon_soup& soup) { return CGAL::IO::read_STL(in, soup.points, soup.faces, silent); }},
}};

const Mesh_format& format_of(const std::filesystem::path& file) {
  const auto extension = lower_case(file.extension().string());
  const auto format = std::ranges::find(formats, extension, &Mesh_format::extension);
  std::error_code ignored;
  if (format == formats.end() && !exists(file, ignored))
    throw Bad_mesh(fmt::format("{}: there is no such file", file.string()));
  if (format == formats.end())
    throw Bad_mesh(fmt::format("{}: {}expected a file .off, .obj, .ply, .stl, .gltf, .glb, .md2 or .md3{}",
                               file.string(), is_directory(file, ignored) ? "this is a folder; " : "",
                               is_directory(file, ignored) ? "" : ", found extension " + in_quotes(extension)));
  return *format;
}

void add_point(const Point& point, Checksum& coordinates) {
  for (int axis = 0; axis < 3; ++axis) coordinates.add_coordinate(point[axis]);
}

/// Whether the soup has exactly the numbers that the guard has read.
bool is_complete(const Polygon_soup& soup, const Guarded_mesh& guarded) {
  const bool welded = guarded.vertices == 0;
  if (soup.faces.size() != guarded.faces || (!welded && soup.points.size() != guarded.vertices)) return false;
  Checksum coordinates, corners;
  if (!welded)
    for (const auto& point : soup.points) add_point(point, coordinates);
  for (const auto& face : soup.faces) {
    if (face.size() < 3) return false;
    for (const auto vertex : face) {
      if (vertex >= soup.points.size()) return false;
      welded ? add_point(soup.points[vertex], coordinates) : corners.add_corner(vertex);
    }
    if (!welded) corners.add_corner(face.size());
  }
  return coordinates == guarded.coordinates && corners == guarded.corners;
}

/// The limit holds for the triangles too: one face can have as many corners as its file has room for.
void check_triangle_count(const std::filesystem::path& file, const Polygon_soup& soup, std::size_t max_faces) {
  std::size_t triangles = 0;
  for (const auto& face : soup.faces) triangles += face.size() - 2;
  const auto most = std::min(max_faces, most_triangles);
  if (triangles > most)
    throw Bad_mesh(
        fmt::format("{}: the faces give {} triangles, where at most {} are allowed", file.string(), triangles, most));
}

/// The first frame of a game model.
Polygon_soup soup_of(const Game_model& model) {
  Polygon_soup soup;
  soup.points.resize(model.vertices);
  try {
    pose_game_model(model, 0, soup.points);
  } catch (const Bad_motion& error) {
    throw Bad_mesh(error.what());
  }
  for (const auto& face : model.faces) soup.faces.emplace_back(face.begin(), face.end());
  soup.joined = model.joined;
  return soup;
}

}  // namespace

Polygon_soup read_polygon_soup(const std::filesystem::path& file, const Mesh_file_options& options) {
  if (is_gltf(file)) return soup_of(read_gltf_scene(file, options));
  if (is_game_model(file)) {
    auto model = soup_of(*read_game_model(file, options));
    model.files = {file};
    return model;
  }
  const auto& format = format_of(file);
  auto guarded = format.guard(File_bytes(file, options.max_bytes), options.max_faces);
  if (guarded.vertices > most_vertices || guarded.faces > most_triangles)
    throw Bad_mesh(fmt::format("{}: {} vertices and {} faces are too many for 32-bit numbers", file.string(),
                               guarded.vertices, guarded.faces));
  std::istringstream plain(std::move(guarded.plain));
  Polygon_soup soup;
  // CGAL's readers can silently misread numbers, for example under a global C++ locale with another decimal separator.
  if (!format.read(plain, soup) || !is_complete(soup, guarded))
    throw Bad_mesh(fmt::format("{}: CGAL's reader did not deliver the {} vertices and {} faces of the file",
                               file.string(), guarded.vertices, guarded.faces));
  soup.parts = std::move(guarded.parts);
  soup.not_read = std::move(guarded.not_read);
  soup.files = {file};
  return soup;
}

Mesh_soup read_mesh_soup(const std::filesystem::path& file, const Mesh_file_options& options) {
  auto polygons = read_polygon_soup(file, options);
  check_triangle_count(file, polygons, options.max_faces);
  return triangulated(std::move(polygons));
}

}  // namespace lodestone
