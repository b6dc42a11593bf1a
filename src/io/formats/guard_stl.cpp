// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "io/files/byte_order.h"
#include "io/formats/mesh_guard.h"

namespace lodestone {
namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, normal_bytes = 12, facet_bytes = 50;

/// Some programs write the keywords in capitals.
bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::ranges::equal(word, keyword, {}, [](unsigned char c) { return std::tolower(c); });
}

void need_keyword(const Text_scanner& text, std::string_view word, std::string_view keyword) {
  if (word.empty()) text.fail(fmt::format("the file ends where '{}' is expected", keyword));
  if (!is_keyword(word, keyword)) text.fail(fmt::format("expected '{}', found {}", keyword, in_quotes(word)));
}

/// Copies the part after the word `facet`. The normal is skipped: it is often wrong, and the corners determine it.
void copy_facet(Text_scanner& text, Guarded_mesh& mesh) {
  mesh.plain += "facet\n";
  need_keyword(text, text.next_word_of_file(), "normal");
  for (int axis = 0; axis < 3; ++axis) text.next_word_of_file();
  need_keyword(text, text.next_word_of_file(), "outer");
  need_keyword(text, text.next_word_of_file(), "loop");
  std::size_t corners = 0;
  auto word = text.next_word_of_file();
  for (; is_keyword(word, "vertex"); word = text.next_word_of_file(), ++corners) {
    mesh.plain += "vertex ";
    copy_coordinates(text, mesh);
  }
  need_keyword(text, word, "endloop");
  if (corners != 3) text.fail(wrong_corners(mesh.faces, corners, "3"));
  need_keyword(text, text.next_word_of_file(), "endfacet");
  mesh.plain += "endfacet\n";
  ++mesh.faces;
}

void copy_solid(Text_scanner& text, std::size_t max_faces, Guarded_mesh& mesh) {
  text.skip_rest_of_line();  // the solid's name, which may contain keywords
  auto word = text.next_word_of_file();
  for (; is_keyword(word, "facet"); word = text.next_word_of_file()) {
    copy_facet(text, mesh);
    if (mesh.faces > max_faces) text.fail(too_many_faces(mesh.faces, max_faces));
  }
  need_keyword(text, word, "endsolid");
  text.skip_rest_of_line();
}

Guarded_mesh guard_text(const File_bytes& file, std::size_t max_faces) {
  Text_scanner text(file);
  Guarded_mesh mesh;
  mesh.plain = "solid\n";
  for (auto word = text.next_word_of_file(); !word.empty(); word = text.next_word_of_file()) {
    if (mesh.faces > 0) mesh.not_read.insert("groups");
    need_keyword(text, word, "solid");
    copy_solid(text, max_faces, mesh);
  }
  if (mesh.faces == 0) text.fail("the file holds no face");
  mesh.plain += "endsolid\n";
  return mesh;
}

void check_corners(const File_bytes& file, std::size_t facet, Guarded_mesh& mesh) {
  const std::size_t first = header_bytes + count_bytes + facet * facet_bytes + normal_bytes;
  for (std::size_t number = 0; number < 9; ++number) {
    const auto at = first + number * sizeof(float);
    const auto coordinate = load<float>(file.view().data() + at);
    if (!std::isfinite(coordinate))
      file.fail_at(at, fmt::format("face {} (counted from 0) has a coordinate that is not finite", facet));
    mesh.coordinates.add_coordinate(coordinate);
  }
}

Guarded_mesh guard_binary(const File_bytes& file, std::size_t max_faces) {
  const auto bytes = file.view();
  if (bytes.size() < header_bytes + count_bytes)
    file.fail_at(bytes.size(), "the file ends within the header; neither 'solid' nor 84 bytes of binary STL are found");
  const std::size_t facets = load<std::uint32_t>(bytes.data() + header_bytes);
  const std::size_t expected = header_bytes + count_bytes + facets * facet_bytes;
  if (bytes.size() != expected)
    file.fail_at(header_bytes, fmt::format("{} faces take {} bytes, the file has {}", facets, expected, bytes.size()));
  if (facets == 0) file.fail_at(header_bytes, "the file holds no face");
  if (facets > max_faces) file.fail_at(header_bytes, too_many_faces(facets, max_faces));

  Guarded_mesh mesh;
  mesh.faces = facets;
  for (std::size_t facet = 0; facet < facets; ++facet) check_corners(file, facet, mesh);
  // Blank, since CGAL's reader would first try to read a header that begins with 'solid' as text.
  mesh.plain = std::string(header_bytes, '\0').append(bytes.substr(header_bytes));
  return mesh;
}

/// The header of a binary file may begin with 'solid' too, but the face count after it contains a zero byte.
bool is_text(std::string_view bytes) {
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  const auto begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  return is_keyword(bytes.substr(begin, 5), "solid") &&
         bytes.substr(0, header_bytes + count_bytes).find('\0') == std::string_view::npos;
}

}  // namespace

Guarded_mesh guard_stl(const File_bytes& file, std::size_t max_faces) {
  return is_text(file.view()) ? guard_text(file, max_faces) : guard_binary(file, max_faces);
}

}  // namespace lodestone
