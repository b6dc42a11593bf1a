// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "io/files/byte_order.h"
#include "io/formats/mesh_guard.h"
#include "io/formats/ply_header.h"
#include "io/formats/ply_values.h"

namespace lodestone {
namespace {

/// The body of the plain copy, in two parts since a file may list its faces first.
struct Plain_body {
  std::string vertices, faces;
};

bool is_vertices(const Ply_element& element) { return element.name == "vertex" || element.name == "vertices"; }
bool is_faces(const Ply_element& element) { return element.name == "face" || element.name == "faces"; }
bool is_corners(const Ply_property& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

void check_vertices(const Ply_element& element, const Text_scanner& text) {
  for (const std::string_view axis : {"x", "y", "z"}) {
    const auto property = std::ranges::find(element.properties, axis, &Ply_property::name);
    if (property == element.properties.end()) text.fail(fmt::format("the vertices have no property '{}'", axis));
    if (property->count_type) text.fail(fmt::format("property '{}' of the vertices is a list", axis));
  }
}

void check_faces(const Ply_element& element, const Text_scanner& text) {
  if (std::ranges::count_if(element.properties, is_corners) != 1)
    text.fail("the faces need one property 'vertex_indices' or 'vertex_index'");
  const auto corners = std::ranges::find_if(element.properties, is_corners);
  if (!corners->count_type || !is_integer(corners->type))
    text.fail(fmt::format("property '{}' of the faces is not a list of integers", corners->name));
}

const Ply_element& only_element(const Ply_header& header, bool (*wanted)(const Ply_element&), std::string_view name,
                                const Text_scanner& text) {
  const auto found = std::ranges::count_if(header.elements, wanted);
  if (found != 1) text.fail(fmt::format("expected one element '{}', found {}", name, found));
  return *std::ranges::find_if(header.elements, wanted);
}

/// What a skipped property of vertices or faces holds, by the usual names.
const char* content_of(std::string_view name) {
  constexpr std::array colours{"red", "green", "blue", "alpha"};
  constexpr std::array normals{"nx", "ny", "nz"};
  constexpr std::array textures{"s", "t", "u", "v", "texture_u", "texture_v", "texcoord", "texnumber"};
  const auto is_among = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
  if (is_among(colours)) return "colours";
  if (is_among(normals)) return "normals";
  return is_among(textures) ? "texture coordinates" : "other properties";
}

void list_skipped(const Ply_element& element, Guarded_mesh& mesh) {
  for (const auto& property : element.properties) {
    const bool is_axis = property.name == "x" || property.name == "y" || property.name == "z";
    const bool is_read = is_vertices(element) ? is_axis : is_corners(property);
    if (!is_read) mesh.not_read.insert(content_of(property.name));
  }
}

/// Checks the header on its own, and reads the counts from it.
void check_header(const Ply_header& header, const Text_scanner& text, std::size_t max_faces, Guarded_mesh& mesh) {
  const auto& vertices = only_element(header, is_vertices, "vertex", text);
  const auto& faces = only_element(header, is_faces, "face", text);
  check_vertices(vertices, text);
  check_faces(faces, text);
  if (vertices.count == 0 || faces.count == 0) text.fail("the file holds no face");
  if (faces.count > max_faces) text.fail(too_many_faces(faces.count, max_faces));
  list_skipped(vertices, mesh);
  list_skipped(faces, mesh);
  for (const auto& element : header.elements)
    if (!is_vertices(element) && !is_faces(element) && element.count > 0) mesh.not_read.insert("other elements");
  mesh.vertices = vertices.count;
  mesh.faces = faces.count;
}

template <class Values>
void check_room(const Values& values, const Ply_element& element) {
  std::size_t least = 0;
  for (const auto& property : element.properties)
    least += Values::least_bytes(property.count_type.value_or(property.type));
  const auto room = values.bytes_left() + 1;  // the last value of a text need not be followed by a blank
  if (least > 0 && element.count > room / least)
    values.fail(too_short_for(element.count, "items of element " + in_quotes(element.name), values.bytes_left()));
}

template <class Values>
std::size_t next_integer(Values& values, Ply_type type, std::string_view what) {
  const double value = values.next(type);
  const double end = std::size_t{1} << 32U;  // the widest integer of PLY has 32 bits
  if (value < 0 || value >= end || value != std::floor(value))
    values.fail(fmt::format("expected {}, found {}", what, value));
  return static_cast<std::size_t>(value);
}

template <class Values>
void skip_property(Values& values, const Ply_property& property) {
  std::size_t items = property.count_type ? next_integer(values, *property.count_type, "a number of items") : 1;
  for (; items > 0; --items) values.skip(property.type);
}

template <class Values>
void copy_vertex(Values& values, const Ply_element& element, Guarded_mesh& mesh, Plain_body& body) {
  std::array<double, 3> point{};
  for (const auto& property : element.properties) {
    const auto axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis != std::string_view::npos)
      point[axis] = values.next(property.type);
    else
      skip_property(values, property);
  }
  for (const double coordinate : point) {
    mesh.coordinates.add_coordinate(coordinate);
    append(body.vertices, coordinate);
  }
}

template <class Values>
void copy_corners(Values& values, std::size_t face, const Ply_property& list, Guarded_mesh& mesh, Plain_body& body) {
  const auto corners = next_integer(values, *list.count_type, "a number of corners");
  if (corners < 3) values.fail(wrong_corners(face, corners, "3 or more"));
  append(body.faces, static_cast<std::uint32_t>(corners));
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const auto vertex = next_integer(values, list.type, "the number of a vertex");
    if (vertex >= mesh.vertices)
      values.fail(fmt::format("face refers to vertex {} of {} (counted from 0)", vertex, mesh.vertices));
    mesh.corners.add_corner(vertex);
    append(body.faces, static_cast<std::uint32_t>(vertex));
  }
  mesh.corners.add_corner(corners);
}

template <class Values>
void copy_element(Values& values, const Ply_element& element, Guarded_mesh& mesh, Plain_body& body) {
  if (element.properties.empty()) return;  // whatever the count, there is nothing to read
  for (std::size_t item = 0; item < element.count; ++item) {
    if (is_vertices(element)) {
      copy_vertex(values, element, mesh, body);
      continue;
    }
    for (const auto& property : element.properties)
      if (is_faces(element) && is_corners(property))
        copy_corners(values, item, property, mesh, body);
      else
        skip_property(values, property);
  }
}

template <class Values>
void copy_elements(Values values, const Ply_header& header, Guarded_mesh& mesh) {
  for (const auto& element : header.elements) check_room(values, element);
  Plain_body body;
  for (const auto& element : header.elements) copy_element(values, element, mesh, body);
  if (!values.at_end()) values.fail("more follows than the header announces");
  mesh.plain = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uint uint vertex_indices\nend_header\n",
      mesh.vertices, mesh.faces);
  mesh.plain.append(body.vertices).append(body.faces);
}

}  // namespace

Guarded_mesh guard_ply(const File_bytes& file, std::size_t max_faces) {
  Text_scanner text(file);
  const auto header = read_ply_header(text);
  Guarded_mesh mesh;
  check_header(header, text, max_faces, mesh);
  if (header.format == Ply_format::ascii) {
    copy_elements(Ply_text_values(text), header, mesh);
  } else {
    const auto order = header.format == Ply_format::binary_big_endian ? std::endian::big : std::endian::little;
    copy_elements(Ply_binary_values(file, text.offset(), order), header, mesh);
  }
  return mesh;
}

}  // namespace lodestone
