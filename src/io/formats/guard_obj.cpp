// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>

#include "io/formats/mesh_guard.h"

namespace lodestone {
namespace {

struct Skipped_statement {
  std::string_view keyword;
  const char* holds;  ///< for a report of what is not read; empty: nothing that a user would miss
};

/// Legal statements that do not affect the triangles. Free-form curves and surfaces are not among them, because
/// skipping those would lose part of the shape.
constexpr std::array<Skipped_statement, 21> skipped_statements = {{
    {"vt", "texture coordinates"},
    {"vn", "normals"},
    {"vp", ""},
    {"g", "groups"},  // both begin a part
    {"o", "groups"},
    {"s", ""},
    {"mg", ""},
    {"l", "lines"},
    {"p", "points"},
    {"usemtl", "materials"},
    {"mtllib", "materials"},
    {"usemap", "materials"},
    {"maplib", "materials"},
    {"bevel", ""},
    {"c_interp", ""},
    {"d_interp", ""},
    {"lod", ""},
    {"shadow_obj", ""},
    {"trace_obj", ""},
    {"ctech", ""},
    {"stech", ""},
}};

/// The largest vertex number found, from 1, and its location. Checked at the end of the file, since a face may refer to
/// vertices that follow it.
struct Farthest_corner {
  std::size_t vertex;
  Text_scanner place;
};

/// The vertex number, from 1, of a corner written as `7`, `-2` (counted back from here) or `7/1/3` (texture, normal).
std::size_t vertex_number(const Text_scanner& text, std::string_view corner, std::size_t vertices) {
  const auto word = corner.substr(0, corner.find('/'));
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || stop != word.data() + word.size())
    text.fail(fmt::format("expected the number of a vertex, found {}", in_quotes(corner)));
  if (number == 0) text.fail("face refers to vertex 0, but vertices are counted from 1");
  if (number > 0) return static_cast<std::size_t>(number);
  // Unsigned, so that it wraps: the smallest 64-bit integer cannot be negated.
  const auto back = std::uint64_t{0} - static_cast<std::uint64_t>(number);
  if (back > vertices) text.fail(fmt::format("face refers to vertex {} with {} vertices so far", number, vertices));
  return vertices + 1 - back;
}

void copy_face(Text_scanner& text, Guarded_mesh& mesh, Farthest_corner& farthest) {
  mesh.plain += 'f';
  std::size_t corners = 0;
  for (auto word = text.next_word(); !word.empty(); word = text.next_word(), ++corners) {
    const auto vertex = vertex_number(text, word, mesh.vertices);
    if (vertex > farthest.vertex) farthest = {vertex, text};
    mesh.corners.add_corner(vertex - 1);
    fmt::format_to(std::back_inserter(mesh.plain), " {}", vertex);
  }
  if (corners < 3) text.fail(wrong_corners(mesh.faces, corners, "3 or more"));
  mesh.corners.add_corner(corners);
  mesh.plain += '\n';
  ++mesh.faces;
}

/// The unread rest of the line, with single spaces. Many programs write names such as `Box#2`, so a comment begins only
/// where a word does.
std::string name_of_part(Text_scanner& text) {
  text.read_comment_as_text();
  std::string name;
  for (auto word = text.next_word(); !word.empty(); word = text.next_word()) {
    if (word.starts_with('#')) {
      text.skip_rest_of_line();
      break;
    }
    (name += name.empty() ? "" : " ") += word;
  }
  return name;
}

void skip_statement(const Text_scanner& text, std::string_view keyword, Guarded_mesh& mesh) {
  const auto statement = std::ranges::find(skipped_statements, keyword, &Skipped_statement::keyword);
  if (statement == skipped_statements.end())
    text.fail(fmt::format("expected a statement of a polygon mesh, found {}", in_quotes(keyword)));
  if (*statement->holds != '\0') mesh.not_read.insert(statement->holds);
}

/// @param groups  the parts that `g` begins; those that `o` begins are the mesh's
void copy_statement(Text_scanner& text, Guarded_mesh& mesh, Farthest_corner& farthest, File_parts& groups) {
  const auto keyword = text.next_word();
  if (keyword == "v") {
    mesh.plain += "v ";
    copy_coordinates(text, mesh);
    ++mesh.vertices;
  } else if (keyword == "f") {
    copy_face(text, mesh, farthest);
  } else if (!keyword.empty()) {
    skip_statement(text, keyword, mesh);
    if (keyword == "o" || keyword == "g")
      begin_part(name_of_part(text), static_cast<std::uint32_t>(mesh.faces), keyword == "o" ? mesh.parts : groups);
  }
}

}  // namespace

Guarded_mesh guard_obj(const File_bytes& file, std::size_t max_faces) {
  Text_scanner text(file, '#', '\\');
  Guarded_mesh mesh;
  Farthest_corner farthest{0, text};
  File_parts groups;
  while (text.next_line()) {
    copy_statement(text, mesh, farthest, groups);
    if (mesh.faces > max_faces) text.fail(too_many_faces(mesh.faces, max_faces));
  }
  if (farthest.vertex > mesh.vertices)
    farthest.place.fail(fmt::format("face refers to vertex {} of {}", farthest.vertex, mesh.vertices));
  if (mesh.faces == 0) text.fail("the file holds no face");
  if (mesh.parts.empty()) mesh.parts = std::move(groups);
  return mesh;
}

}  // namespace lodestone
