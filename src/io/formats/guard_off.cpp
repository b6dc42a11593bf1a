// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "io/formats/mesh_guard.h"

namespace lodestone {
namespace {

/// Vertex lines may have texture coordinates (ST), a colour (C) and a normal (N), which are skipped.
bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

/// Reads the keyword and the counts, which may be on one line or on two. The number of edges is ignored.
void read_header(Text_scanner& text, std::size_t max_faces, Guarded_mesh& mesh) {
  text.next_line();
  const auto keyword = text.next_word();
  if (!is_off_keyword(keyword))
    text.fail(fmt::format("expected OFF, COFF, NOFF or alike, found {}", in_quotes(keyword)));
  auto word = text.next_word_of_file();
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
  if (corners != 3) text.fail(not_a_triangle(face, corners));
  mesh.plain += '3';
  for (int corner = 0; corner < 3; ++corner) {
    const auto word = text.next_word();
    if (word.empty()) text.fail(fmt::format("face {} (counted from 0) ends after {} corners", face, corner));
    const auto vertex = text.count(word);
    if (vertex >= mesh.vertices)
      text.fail(fmt::format("face refers to vertex {} of {} (counted from 0)", vertex, mesh.vertices));
    mesh.corners.add_corner(vertex);
    (mesh.plain += ' ').append(word);
  }
  mesh.plain += '\n';
}

}  // namespace

Guarded_mesh guard_off(const File_bytes& file, std::size_t max_faces) {
  Text_scanner text(file, '#');
  Guarded_mesh mesh;
  read_header(text, max_faces, mesh);
  mesh.plain = fmt::format("OFF\n{} {} 0\n", mesh.vertices, mesh.faces);
  for (std::size_t vertex = 0; vertex < mesh.vertices; ++vertex) {
    if (!text.next_line()) text.fail(fmt::format("the file ends after {} of {} vertices", vertex, mesh.vertices));
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
