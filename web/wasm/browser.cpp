// SPDX-License-Identifier: GPL-3.0-or-later
// What the page in the browser asks: two mesh files, or one and itself, and the viewer's data of the answer.
#include <emscripten/bind.h>
#include <emscripten/emscripten.h>

#include <optional>

#include "io/meshes/read_mesh_soup.h"
#include "io/results/page_frame.h"
#include "lodestone/detection/frame_at_once.h"
#include "lodestone/io/results/page.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/indexed_mesh.h"

namespace lodestone {

namespace {

using emscripten::val;

/// A mesh as arrays.
struct Read_mesh {
  explicit Read_mesh(const std::filesystem::path& file) : name(file.filename().string()) {
    const Mesh_soup soup = read_mesh_soup(file);
    coordinates.reserve(3 * soup.points.size());
    for (const auto& p : soup.points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    corners = corners_of(soup);
  }

  Positions positions() const {
    return Eigen::Map<const Positions>(coordinates.data(), static_cast<Eigen::Index>(coordinates.size() / 3), 3);
  }
  Triangle triangle(std::uint32_t face) const {
    return face_triangle(corners[face], [this](std::uint32_t v) { return coordinates.data() + 3 * std::size_t{v}; });
  }

  std::string name;
  std::vector<double> coordinates;
  std::vector<Corners> corners;
};

/// The collisions of two meshes, or of one with itself.
/// @return collides, contacts, milliseconds, and data: the container of docs/page_format.md
val answer(const Read_mesh& a, const std::optional<Read_mesh>& other) {
  const Read_mesh& b = other ? *other : a;
  const Indexed_mesh mesh_a(a.coordinates, a.corners), mesh_b(b.coordinates, b.corners);
  const double began = emscripten_get_now();
  std::optional<Frame> frame;
  if (other)
    frame = frame_at_once(mesh_a, mesh_b, Detector_options{});
  else
    frame = self_frame_at_once(mesh_a, Detector_options{});
  const double milliseconds = emscripten_get_now() - began;
  if (!frame) throw Bad_mesh("one of the meshes has no face, or a coordinate that is not finite");

  Page page({.title = other ? a.name + " and " + b.name : a.name + " and itself", .mode = "exact"});
  page.add_object(a.name, static_cast<std::uint32_t>(a.coordinates.size() / 3), a.corners);
  if (other) page.add_object(b.name, static_cast<std::uint32_t>(b.coordinates.size() / 3), b.corners);
  Page_frame shown{.positions = {a.positions()}};
  if (other) shown.positions.push_back(b.positions());
  shown.contacts =
      page_contacts(*frame, [&](Object_id object, std::uint32_t face) { return (object == 0 ? a : b).triangle(face); });
  page.add_frame(std::move(shown));
  const std::string data = page.data();

  val result = val::object();
  result.set("collides", frame->collides());
  result.set("contacts", frame->face_pairs.size());
  result.set("milliseconds", milliseconds);
  result.set("data", val::global("Uint8Array")
                         .new_(emscripten::typed_memory_view(data.size(),
                                                             reinterpret_cast<const unsigned char*>(data.data()))));
  return result;
}

/// @param files  one or two paths in the module's file system
val check_files(const std::string& first, const std::string& second) {
  try {
    const Read_mesh a(first);
    std::optional<Read_mesh> b;
    if (!second.empty()) b.emplace(second);
    return answer(a, b);
  } catch (const std::exception& error) {
    val result = val::object();
    result.set("error", std::string(error.what()));
    return result;
  }
}

}  // namespace

EMSCRIPTEN_BINDINGS(lodestone) { emscripten::function("check", &check_files); }

}  // namespace lodestone
