// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/game_model.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_set>

#include "io/files/byte_order.h"
#include "io/files/file_bytes.h"
#include "io/files/small_text.h"
#include "io/formats/mesh_guard.h"
#include "io/formats/mesh_soup.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

/// Reads numbers at offsets that the file specifies. No offset or count is trusted.
class Model_reader {
 public:
  Model_reader(const File_bytes& file, const Mesh_file_options& options) : file_(file), options_(options) {}

  Game_model read();

 private:
  void read_md2();
  void read_md3();
  void read_md3_surface(std::size_t at, std::size_t length);
  void add_face(std::size_t at, std::size_t first, std::size_t vertices, std::size_t bytes_per_corner);

  /// The count or offset that is stored at byte `at` of the file.
  std::size_t number(std::size_t at) const {
    const auto value = load<std::int32_t>(file_.view().data() + at);
    if (value < 0) file_.fail_at(at, fmt::format("expected a number of 0 or more, found {}", value));
    return static_cast<std::size_t>(value);
  }
  void expect_version(std::size_t version) const {
    if (number(4) != version) file_.fail_at(4, fmt::format("expected version {}, found {}", version, number(4)));
  }
  /// Refuses a file that is too short for `count` items of `bytes` bytes from `offset` on.
  void expect_room(std::size_t at, std::size_t offset, std::size_t count, std::size_t bytes, const char* things) const {
    const auto size = file_.view().size();
    if (offset > size || count > (size - offset) / bytes)
      file_.fail_at(
          at, fmt::format("{} {} from byte {} on do not fit into a file of {} bytes", count, things, offset, size));
  }

  const File_bytes& file_;
  const Mesh_file_options& options_;
  Game_model model_ = {};
};

void Model_reader::add_face(std::size_t at, std::size_t first, std::size_t vertices, std::size_t bytes_per_corner) {
  constexpr std::array<std::size_t, 3> other_way_round{0, 2, 1};  // they are clockwise, seen from outside
  Corners face{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto place = at + corner * bytes_per_corner;
    const auto* const bytes = file_.view().data() + place;
    const std::uint32_t vertex = bytes_per_corner == 2 ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
    if (vertex >= vertices)
      file_.fail_at(place, fmt::format("face refers to vertex {} of {} (counted from 0)", vertex, vertices));
    face[other_way_round[corner]] = static_cast<std::uint32_t>(first + vertex);
  }
  model_.faces.push_back(face);
  if (model_.faces.size() > options_.max_faces)
    file_.fail_at(at, too_many_faces(model_.faces.size(), options_.max_faces));
}

// MD2: 17 numbers, then the data at the offsets among them. A frame is a scale and an offset per axis, a name, and per
// vertex three bytes and the index of a normal.
constexpr std::size_t md2_header = 68, md2_frame_header = 40, md2_vertex = 4, md2_triangle = 12;

void Model_reader::read_md2() {
  if (file_.view().size() < md2_header) file_.fail_at(file_.view().size(), "the file ends within the header");
  expect_version(8);
  const auto frame_bytes = number(16), vertices = number(24), faces = number(32), frames = number(40);
  const auto triangles_at = number(52), frames_at = number(56);
  if (frames == 0 || vertices == 0 || faces == 0) file_.fail_at(24, "the file holds no face or no frame");
  if (vertices > file_.view().size() || frame_bytes < md2_frame_header + vertices * md2_vertex)
    file_.fail_at(16, fmt::format("frames of {} bytes cannot hold {} vertices", frame_bytes, vertices));
  expect_room(32, triangles_at, faces, md2_triangle, "triangles");
  expect_room(40, frames_at, frames, frame_bytes, "frames");
  model_.is_md2 = true;
  model_.frames = frames;
  model_.vertices = vertices;
  model_.surfaces = {{vertices, frames_at, frame_bytes}};
  for (std::size_t face = 0; face < faces; ++face) add_face(triangles_at + face * md2_triangle, 0, vertices, 2);
}

// MD3: a header, then surfaces one after the other, each with its own header. Offsets are relative to the start of the
// surface. A vertex is three 16-bit numbers, in 64ths, and a normal. The vertices are stored frame after frame.
constexpr std::size_t md3_header = 108, md3_surface_header = 108, md3_vertex = 8, md3_triangle = 12;

void Model_reader::read_md3() {
  if (file_.view().size() < md3_header) file_.fail_at(file_.view().size(), "the file ends within the header");
  expect_version(15);
  model_.frames = number(76);
  const auto surfaces = number(84);
  if (model_.frames == 0) file_.fail_at(76, "the file holds no frame");
  auto at = number(100);
  for (std::size_t surface = 0; surface < surfaces; ++surface) {
    expect_room(100, at, 1, md3_surface_header, "surface headers");
    const auto length = number(at + 104);
    if (length < md3_surface_header) file_.fail_at(at + 104, fmt::format("a surface cannot have {} bytes", length));
    read_md3_surface(at, length);
    at += length;
  }
  if (model_.faces.empty()) file_.fail_at(84, "the file holds no face");
}

void Model_reader::read_md3_surface(std::size_t at, std::size_t length) {
  const auto frames = model_.frames;
  const auto own_frames = number(at + 72), vertices = number(at + 80), faces = number(at + 84);
  const auto triangles_at = at + number(at + 88), vertices_at = at + number(at + 100);
  if (own_frames != frames)
    file_.fail_at(at + 72, fmt::format("the surface has {} frames, the file {}", own_frames, frames));
  expect_room(at + 84, triangles_at, faces, md3_triangle, "triangles");
  expect_room(at + 80, vertices_at, vertices, md3_vertex, "vertices");
  if (vertices > 0) expect_room(at + 72, vertices_at, frames, vertices * md3_vertex, "frames");
  // If surfaces could share bytes, a short file could describe more data than fits into memory.
  if (triangles_at + faces * md3_triangle > at + length || vertices_at + frames * vertices * md3_vertex > at + length)
    file_.fail_at(at + 104, fmt::format("the surface does not end within its {} bytes", length));
  for (std::size_t face = 0; face < faces; ++face)
    add_face(triangles_at + face * md3_triangle, model_.vertices, vertices, 4);
  model_.surfaces.push_back({vertices, vertices_at, vertices * md3_vertex});
  model_.vertices += vertices;
}

// ---- Welding ----

/// The position of an MD3 vertex in one frame, as bytes; its normal is ignored.
std::string_view position_bytes(const Game_model& model, const Game_surface& surface, std::size_t vertex,
                                std::size_t frame) {
  constexpr std::size_t bytes = 6;
  return std::string_view(model.bytes)
      .substr(surface.first_frame + frame * surface.frame_bytes + vertex * md3_vertex, bytes);
}

struct Same_place {
  const Game_model* model;
  const Game_surface* surface;

  std::size_t operator()(std::uint32_t vertex) const {
    std::size_t hash = 0;
    for (std::size_t frame = 0; frame < model->frames; ++frame)
      hash = (hash ^ std::hash<std::string_view>()(position_bytes(*model, *surface, vertex, frame))) * 31;
    return hash;
  }
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t frame = 0; frame < model->frames; ++frame)
      if (position_bytes(*model, *surface, a, frame) != position_bytes(*model, *surface, b, frame)) return false;
    return true;
  }
};

/// Joins vertices that have the same position in every frame. MD3 duplicates vertices at texture seams; MD2 does not.
void weld(Game_model& model) {
  std::vector<std::uint32_t> first_of;
  for (const auto& surface : model.surfaces) {
    const auto first = static_cast<std::uint32_t>(first_of.size());
    const Same_place same{&model, &surface};
    std::unordered_set<std::uint32_t, Same_place, Same_place> seen(surface.vertices, same, same);
    for (std::uint32_t vertex = 0; vertex < surface.vertices; ++vertex)
      first_of.push_back(first + *seen.insert(vertex).first);
  }
  model.joined = joined_of(first_of, model.faces);
  for (auto& face : model.faces)
    for (auto& corner : face) corner = first_of[corner];
}

Game_model Model_reader::read() {
  model_.name = file_.name();
  if (file_.view().starts_with("IDP2"))
    read_md2();
  else if (file_.view().starts_with("IDP3"))
    read_md3();
  else
    file_.fail_at(0, "expected IDP2 or IDP3, this is not an MD2 or MD3 model");
  model_.bytes = file_.view();
  if (!model_.is_md2) weld(model_);
  return std::move(model_);
}

}  // namespace

bool is_game_model(const std::filesystem::path& file) {
  const auto extension = lower_case(file.extension().string());
  return extension == ".md2" || extension == ".md3";
}

std::shared_ptr<const Game_model> read_game_model(const std::filesystem::path& file, const Mesh_file_options& options) {
  const File_bytes bytes(file, options.max_bytes);
  return std::make_shared<const Game_model>(Model_reader(bytes, options).read());
}

void pose_game_model(const Game_model& model, std::size_t frame, std::span<Point> positions) {
  std::size_t next = 0;
  for (const auto& [vertices, first_frame, frame_bytes] : model.surfaces) {
    const char* bytes = model.bytes.data() + first_frame + frame * frame_bytes;
    for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
      std::array<double, 3> at{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (model.is_md2) {
          const auto step = load<std::uint8_t>(bytes + md2_frame_header + vertex * md2_vertex + axis);
          at[axis] = static_cast<double>(step) * load<float>(bytes + 4 * axis) + load<float>(bytes + 12 + 4 * axis);
        } else {
          at[axis] = load<std::int16_t>(bytes + vertex * md3_vertex + 2 * axis) / 64.0;
        }
        if (!std::isfinite(at[axis]))
          throw Bad_motion(
              fmt::format("{}: frame {} (counted from 0): a scale or offset is not finite", model.name, frame));
      }
      positions[next++] = Point(at[0], at[1], at[2]);
    }
  }
}

}  // namespace lodestone
