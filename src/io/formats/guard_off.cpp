// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "io/formats/mesh_guard.h"

namespace lodestone {
namespace {

struct Off_prefix {
  std::string_view text;
  const char* holds;
};
/// What vertex lines may have beside the position. Geomview's order is that of this list; MeshLab has others.
constexpr std::array<Off_prefix, 3> prefixes = {{{"ST", "texture coordinates"}, {"C", "colours"}, {"N", "normals"}}};

/// Reads a keyword such as `OFF`, `CNOFF` or `NCOFF`.
bool is_off_keyword(std::string_view word, Guarded_mesh& mesh) {
  const auto begins = [&](const Off_prefix& prefix) { return word.starts_with(prefix.text); };
  for (auto prefix = std::ranges::find_if(prefixes, begins); prefix != prefixes.end() && word != "OFF";
       prefix = std::ranges::find_if(prefixes, begins)) {
    word.remove_prefix(prefix->text.size());
    mesh.not_read.insert(prefix->holds);
  }
  return word == "OFF";
}

/// Some files of ModelNet have no blank between the keyword and the number of vertices: `OFF490926 662096 0`.
bool is_off_with_count(std::string_view word) {
  return word.starts_with("OFF") && word.size() > 3 && word.find_first_not_of("0123456789", 3) == word.npos;
}

/// Reads the keyword and the counts, which may be on one line or on two. The number of edges is ignored.
void read_header(Text_scanner& text, std::size_t max_faces, Guarded_mesh& mesh) {
  text.next_line();
  const auto keyword = text.next_word();
  const bool with_count = is_off_with_count(keyword);
  if (!with_count && !is_off_keyword(keyword, mesh))
    text.fail(fmt::format("expected OFF, COFF, NOFF or alike, found {}", in_quotes(keyword)));
  const auto word = with_count ? keyword.substr(3) : text.next_word_of_file();
  if (word == "BINARY") text.fail("binary OFF is not supported, only text");
  mesh.vertices = text.count(word);
  mesh.faces = text.count(text.next_word());
  if (mesh.faces == 0 || mesh.vertices == 0) text.fail("the file holds no face");
  if (mesh.faces > max_faces) text.fail(too_many_faces(mesh.faces, max_faces));

  const std::size_t shortest_vertex = 5, shortest_face = 7;  // `0 0 0` and `3 0 0 0`
  const auto left = text.bytes_left();
  if (mesh.vertices > left / shortest_vertex) text.fail(too_short_for(mesh.vertices, "vertices", left));
  if (mesh.faces > left / shortest_face) text.fail(too_short_for(mesh.faces, "faces", left));
}

void copy_face(Text_scanner& text, std::size_t face, Guarded_mesh& mesh) {
  const auto corners = text.count(text.next_word());
  if (corners < 3) text.fail(wrong_corners(face, corners, "3 or more"));
  fmt::format_to(std::back_inserter(mesh.plain), "{}", corners);
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const auto word = text.next_word();
    if (word.empty()) text.fail(fmt::format("face {} (counted from 0) ends after {} corners", face, corner));
    const auto vertex = text.count(word);
    if (vertex >= mesh.vertices)
      text.fail(fmt::format("face refers to vertex {} of {} (counted from 0)", vertex, mesh.vertices));
    mesh.corners.add_corner(vertex);
    (mesh.plain += ' ').append(word);
  }
  mesh.corners.add_corner(corners);
  mesh.plain += '\n';
  if (!text.next_word().empty()) mesh.not_read.insert("colours");
}

}  // namespace

Guarded_mesh guard_off(const File_bytes& file, std::size_t max_faces) {
  Text_scanner text(file, '#');
  Guarded_mesh mesh;
  read_header(text, max_faces, mesh);
  mesh.plain = fmt::format("OFF\n{} {} 0\n", mesh.vertices, mesh.faces);
  for (std::size_t vertex = 0; vertex < mesh.vertices; ++vertex) {
    if (!text.next_line())
      text.fail(fmt::format("the file ends after {} of {} vertices, of which each has a line", vertex, mesh.vertices));
    copy_coordinates(text, mesh);
  }
  for (std::size_t face = 0; face < mesh.faces; ++face) {
    if (!text.next_line()) text.fail(fmt::format("the file ends after {} of {} faces", face, mesh.faces));
    copy_face(text, face, mesh);
  }
  if (text.next_line()) text.fail(fmt::format("more lines follow the {} faces of the header", mesh.faces));
  return mesh;
}

}  // namespace lodestone
