// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <limits>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// `text` with the first `from` replaced; `from` must occur.
std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// One PLY header line differs from the square's.
std::string changed_ply(const std::string& from, const std::string& to) { return changed(square_ply(), from, to); }

class Hostile_mesh : public testing::Test {
 protected:
  /// Reading must fail with Bad_mesh: file, line or byte, and cause, on one line.
  /// @param rest  the message after the file's name, or its beginning
  void expect_error(const std::string& name, std::string_view bytes, const std::string& rest) const {
    expect_error(folder.write(name, bytes), rest);
  }

  static void expect_error(const std::filesystem::path& file, const std::string& rest,
                           const Mesh_file_options& options = {}) {
    try {
      read_mesh(file, options);
      ADD_FAILURE() << file << " was read";
    } catch (const Bad_mesh& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.substr(0, file.string().size() + rest.size()), file.string() + rest);
      EXPECT_TRUE(std::ranges::all_of(message, [](unsigned char c) { return std::isprint(c); })) << message;
    }
  }

  Temporary_folder folder;
};

TEST_F(Hostile_mesh, a_missing_file_is_refused) { expect_error(folder.path() / "none.off", ": there is no such file"); }

TEST_F(Hostile_mesh, a_folder_is_refused) {
  const auto inner = folder.path() / "folder.off";
  create_directory(inner);
  expect_error(inner, ": this is a folder");
  expect_error(folder.path(), ": this is a folder; expected a file .off, .obj");
}

TEST_F(Hostile_mesh, an_empty_file_is_refused) {
  for (const auto* name : {"a.off", "a.obj", "a.ply", "a.stl"}) expect_error(name, "", ": the file is empty");
}

TEST_F(Hostile_mesh, an_unknown_or_missing_extension_is_refused) {
  expect_error("mesh.xyz", square_off,
               ": expected a file .off, .obj, .ply, .stl, .gltf, .glb, .md2 or .md3, found extension '.xyz'");
  expect_error("mesh", square_off,
               ": expected a file .off, .obj, .ply, .stl, .gltf, .glb, .md2 or .md3, found extension ''");
}

TEST_F(Hostile_mesh, binary_garbage_is_refused) {
  std::mt19937 random(7);
  std::string rubbish(5000, '\0');
  for (char& c : rubbish) c = static_cast<char>(random());
  for (const auto* name : {"a.off", "a.obj", "a.ply"}) expect_error(name, rubbish, ":");
  expect_error("a.stl", rubbish, ": byte 80: ");
}

TEST_F(Hostile_mesh, a_file_of_blanks_is_refused) {
  for (const auto* name : {"a.off", "a.obj", "a.ply"}) expect_error(name, " \n\n \t\r\n", ":3: ");
  expect_error("a.stl", " \n\n \t\r\n", ": byte 7: the file ends within the header");
}

TEST_F(Hostile_mesh, a_line_of_a_million_characters_gives_a_short_message) {
  expect_error("a.off", "OFF\n4 2 0\n" + std::string(1'000'000, '1') + "x 0 0\n" + square_off, ":3: expected a number");
}

TEST_F(Hostile_mesh, a_gigabyte_of_zeros_is_refused_at_once) {
  for (const auto* name : {"a.off", "a.obj", "a.ply"}) {
    const auto file = folder.write(name, "");
    resize_file(file, std::uintmax_t{1} << 30U);
    expect_error(file, ":1: the line is longer than 64 MiB");
  }
}

TEST_F(Hostile_mesh, more_faces_than_the_limit_are_refused) {
  expect_error(folder.write("a.off", square_off), ":2: 2 faces or more, where at most 1 are allowed", {.max_faces = 1});
  expect_error(folder.write("a.obj", square_obj), ":6: 2 faces or more", {.max_faces = 1});
  expect_error(folder.write("a.stl", square_text_stl), ":15: 2 faces or more", {.max_faces = 1});
  expect_error(folder.write("b.stl", square_binary_stl()), ": byte 80: 2 faces or more", {.max_faces = 1});
}

// OFF

TEST_F(Hostile_mesh, off_with_counts_too_large_for_the_file_is_refused) {
  expect_error("a.off", changed(square_off, "4 2 0", "4 40000000 0"),
               ":2: 40000000 faces do not fit into the 42 bytes");
  expect_error("a.off", changed(square_off, "4 2 0", "4000000000 2 0"), ":2: 4000000000 vertices do not fit into");
  expect_error("a.off", changed(square_off, "4 2 0", "4 4000000000 0"), ":2: 4000000000 faces or more, where at most");
  expect_error("a.off", changed(square_off, "4 2 0", "18446744073709551615 2 0"), ":2: 18446744073709551615 vertices");
  expect_error("a.off", changed(square_off, "4 2 0", "18446744073709551616 2 0"),
               ":2: expected a count, found '18446744073709551616'");
}

TEST_F(Hostile_mesh, off_with_negative_missing_or_broken_counts_is_refused) {
  expect_error("a.off", changed(square_off, "4 2 0", "-4 2 0"), ":2: expected a count, found '-4'");
  expect_error("a.off", changed(square_off, "4 2 0", "4"), ":2: expected a count, found ''");
  expect_error("a.off", changed(square_off, "4 2 0", "4.5 2 0"), ":2: expected a count, found '4.5'");
  expect_error("a.off", "OFF", ":1: expected a count, found ''");
}

TEST_F(Hostile_mesh, off_without_faces_or_vertices_is_refused) {
  expect_error("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", ":2: the file holds no face");
  expect_error("a.off", "OFF\n0 1 0\n3 0 0 0\n", ":2: the file holds no face");
}

TEST_F(Hostile_mesh, off_with_another_keyword_is_refused) {
  expect_error("a.off", changed(square_off, "OFF", "OOF"), ":1: expected OFF, COFF, NOFF or alike, found 'OOF'");
  expect_error("a.off", changed(square_off, "OFF", "4OFF"), ":1: expected OFF");
  expect_error("a.off", changed(square_off, "OFF\n", ""), ":1: expected OFF, COFF, NOFF or alike, found '4'");
  expect_error("a.off", changed(square_off, "OFF", "OFF BINARY"), ":1: binary OFF is not supported");
}

TEST_F(Hostile_mesh, off_with_a_vertex_index_out_of_range_is_refused) {
  expect_error("a.off", changed(square_off, "3 0 2 3", "3 0 2 4"), ":8: face refers to vertex 4 of 4 (counted from 0)");
  expect_error("a.off", changed(square_off, "3 0 2 3", "3 0 2 -1"), ":8: expected a count, found '-1'");
  expect_error("a.off", changed(square_off, "3 0 2 3", "3 0 2 1e0"), ":8: expected a count, found '1e0'");
}

TEST_F(Hostile_mesh, off_with_a_face_of_too_few_corners_is_refused) {
  expect_error("a.off", changed(square_off, "3 0 1 2", "2 0 1 2"), ":7: face 0 (counted from 0) has 2 corners");
  expect_error("a.off", changed(square_off, "3 0 1 2", "3 0 1"), ":7: face 0 (counted from 0) ends after 2 corners");
}

TEST_F(Hostile_mesh, off_with_a_non_finite_coordinate_is_refused) {
  expect_error("a.off", changed(square_off, "1 1 0", "1 nan 0"), ":5: 'nan' is not a finite number");
  expect_error("a.off", changed(square_off, "1 1 0", "1 -inf 0"), ":5: '-inf' is not a finite number");
  expect_error("a.off", changed(square_off, "1 1 0", "1 1e999 0"), ":5: '1e999' is outside the range of a double");
  expect_error("a.off", changed(square_off, "1 1 0", "1 1,5 0"), ":5: expected a number, found '1,5'");
  expect_error("a.off", changed(square_off, "1 1 0", "1 0x10 0"), ":5: expected a number, found '0x10'");
  expect_error("a.off", changed(square_off, "1 1 0", "1 +-1 0"), ":5: expected a number, found '+-1'");
  expect_error("a.off", changed(square_off, "1 1 0", "1 1"), ":5: expected 3 coordinates, found 2");
}

TEST_F(Hostile_mesh, off_that_is_truncated_or_too_long_is_refused) {
  const auto header = std::string("OFF\n3 2 0\n");
  expect_error("a.off", header + "0.00 0.00 0.00\n1.00 0.00 0.00\n", ":4: the file ends after 2 of 3 vertices");
  expect_error("a.off", header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ":6: the file ends after 1 of 2 faces");
  expect_error("a.off", square_off + "3 0 1 3\n", ":9: more lines follow the 2 faces of the header");
}

// OBJ

TEST_F(Hostile_mesh, obj_with_a_vertex_index_out_of_range_is_refused) {
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 3 9001"), ":6: face refers to vertex 9001 of 4");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 0 1 2"), ":6: face refers to vertex 0, but vertices are");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2 -5"), ":6: face refers to vertex -5 with 4 vertices");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2 -9223372036854775808"),
               ":6: face refers to vertex -9223");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2 9223372036854775808"), ":6: expected the number of a");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2 3.5"),
               ":6: expected the number of a vertex, found '3.5'");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2 /3"), ":6: expected the number of a vertex, found '/3'");
}

TEST_F(Hostile_mesh, obj_with_a_face_of_too_few_corners_is_refused) {
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f 1 2"), ":6: face 1 (counted from 0) has 2 corners");
  expect_error("a.obj", changed(square_obj, "f 1 3 4", "f"), ":6: face 1 (counted from 0) has 0 corners");
}

TEST_F(Hostile_mesh, obj_with_a_non_finite_coordinate_is_refused) {
  expect_error("a.obj", changed(square_obj, "v 1 1 0", "v 1 NaN 0"), ":3: 'NaN' is not a finite number");
  expect_error("a.obj", changed(square_obj, "v 1 1 0", "v 1 inf 0"), ":3: 'inf' is not a finite number");
  expect_error("a.obj", changed(square_obj, "v 1 1 0", "v 1 one 0"), ":3: expected a number, found 'one'");
  expect_error("a.obj", changed(square_obj, "v 1 1 0", "v 1 1"), ":3: expected 3 coordinates, found 2");
}

TEST_F(Hostile_mesh, obj_without_faces_or_with_other_than_polygons_is_refused) {
  expect_error("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ":3: the file holds no face");
  expect_error("a.obj", "f 1 2 3\n", ":1: face refers to vertex 3 of 0");
  expect_error("a.obj", square_obj + "surf 0 1 0 1 1 2 3 4\n",
               ":7: expected a statement of a polygon mesh, found 'surf'");
}

// PLY

TEST_F(Hostile_mesh, ply_with_counts_too_large_for_the_file_is_refused) {
  expect_error("a.ply", changed_ply("face 2", "face 4000000000"), ":9: 4000000000 faces or more, where at most");
  expect_error("a.ply", changed_ply("face 2", "face 40000000"), ":9: 40000000 items of element 'face' do not fit into");
  expect_error("a.ply", changed_ply("vertex 4", "vertex 4000000000"), ":9: 4000000000 items of element 'vertex'");
  expect_error("a.ply", changed_ply("vertex 4", "vertex 18446744073709551615"), ":9: 18446744073709551615 items");
  expect_error("a.ply", changed_ply("vertex 4", "vertex 18446744073709551616"), ":3: expected a count");
  expect_error("a.ply", changed_ply("vertex 4", "vertex -4"), ":3: expected a count, found '-4'");
  const auto binary = changed(square_ply(std::endian::little), "vertex 4", "vertex 4000000000");
  expect_error("b.ply", binary, ": byte " + std::to_string(binary.find("end_header\n") + 11) + ": 4000000000 items");
}

TEST_F(Hostile_mesh, ply_without_faces_or_vertices_is_refused) {
  expect_error("a.ply", changed_ply("face 2", "face 0"), ":9: the file holds no face");
  expect_error("a.ply", changed_ply("vertex 4", "vertex 0"), ":9: the file holds no face");
  expect_error("a.ply", changed_ply("element face", "element facet"), ":9: expected one element 'face', found 0");
  expect_error("a.ply", changed_ply("element face", "element vertex"), ":9: expected one element 'vertex', found 2");
}

TEST_F(Hostile_mesh, ply_with_a_broken_header_is_refused) {
  expect_error("a.ply", changed_ply("ply", "plx"), ":1: expected 'ply', found 'plx'");
  expect_error("a.ply", changed_ply("ascii", "binary"), ":2: expected ascii, binary_little_endian or");
  expect_error("a.ply", changed_ply("1.0", "2.0"), ":2: expected PLY version 1.0, found '2.0'");
  expect_error("a.ply", changed_ply("float x", "real x"), ":4: expected a number type such as float or uint8");
  expect_error("a.ply", changed_ply("float x", "float"), ":4: the line ends before the name");
  expect_error("a.ply", changed_ply("float x", "float w"), ":9: the vertices have no property 'x'");
  expect_error("a.ply", changed_ply("float x", "float y"), ":5: duplicate property 'y' in one element");
  expect_error("a.ply", changed_ply("float x", "list uchar float x"), ":9: property 'x' of the vertices is a list");
  expect_error("a.ply", changed_ply("element vertex 4\n", ""), ":3: a property stands before the first element");
  expect_error("a.ply", changed_ply("element face", "elephant face"), ":7: expected element, property or end_header");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", ":3: the file ends within the header");
}

TEST_F(Hostile_mesh, ply_with_invalid_lists_is_refused) {
  expect_error("a.ply", changed_ply("list uchar int", "list float int"), ":8: the number of items of a list is no");
  expect_error("a.ply", changed_ply("list uchar int", "list uchar float"),
               ":9: property 'vertex_indices' of the faces is");
  expect_error("a.ply", changed_ply("list uchar int", "int"),
               ":9: property 'vertex_indices' of the faces is not a list");
  expect_error("a.ply", changed_ply("vertex_indices", "corners"), ":9: the faces need one property 'vertex_indices'");
  expect_error("a.ply", changed_ply("3 0 1 2", "-3 0 1 2"), ":14: expected a number of corners, found -3");
  expect_error("a.ply", changed_ply("3 0 1 2", "2.5 0 1 2"), ":14: expected a number of corners, found 2.5");
  expect_error("a.ply",
               changed_ply("list uchar int vertex_indices",
                           "list uint uchar far\nproperty list uchar int "
                           "vertex_indices"),
               ":16: the file ends before all that its header announces");
}

TEST_F(Hostile_mesh, ply_with_a_vertex_index_out_of_range_or_too_few_corners_is_refused) {
  expect_error("a.ply", changed_ply("3 0 2 3", "3 0 2 4"), ":15: face refers to vertex 4 of 4 (counted from 0)");
  expect_error("a.ply", changed_ply("3 0 2 3", "3 0 2 -1"), ":15: expected the number of a vertex, found -1");
  expect_error("a.ply", changed_ply("3 0 2 3", "2 0 2"), ":15: face 1 (counted from 0) has 2 corners");
  auto binary = square_ply(std::endian::little);
  const auto last_index = binary.size() - 4;
  binary.replace(last_index, 4, packed<std::int32_t>({-2}));
  expect_error("b.ply", binary, ": byte " + std::to_string(last_index) + ": expected the number of a vertex, found -2");
}

TEST_F(Hostile_mesh, ply_with_a_non_finite_coordinate_is_refused) {
  expect_error("a.ply", changed_ply("1 1 0", "1 nan 0"), ":12: 'nan' is not a finite number");
  expect_error("a.ply", changed_ply("1 1 0", "1 1e999 0"), ":12: '1e999' is outside the range of a double");
  expect_error("a.ply", changed_ply("1 1 0", "1 one 0"), ":12: expected a number, found 'one'");
  for (const auto order : {std::endian::little, std::endian::big}) {
    auto binary = square_ply(order);
    const auto first = binary.find("end_header\n") + 11;
    binary.replace(first, 4, packed<float>({infinite}, order));
    expect_error("b.ply", binary, ": byte " + std::to_string(first) + ": a coordinate is not finite");
  }
}

TEST_F(Hostile_mesh, ply_that_is_truncated_or_too_long_is_refused) {
  expect_error("a.ply", changed_ply("3 0 2 3\n", "3 0 2\n"), ":15: the file ends before all that its header announces");
  expect_error("a.ply", square_ply() + "3 0 1 3\n", ":16: more follows than the header announces");
  auto binary = square_ply(std::endian::little);
  expect_error("b.ply", binary + 'x', ": byte ");
  binary.pop_back();
  expect_error("c.ply", binary, ": byte " + std::to_string(binary.size() - 3) + ": the file ends before all");
}

// STL

TEST_F(Hostile_mesh, binary_stl_whose_face_count_contradicts_its_size_is_refused) {
  auto bytes = square_binary_stl();
  expect_error("a.stl", bytes + 'x', ": byte 80: 2 faces take 184 bytes, the file has 185");
  expect_error("a.stl", bytes.substr(0, 183), ": byte 80: 2 faces take 184 bytes, the file has 183");
  expect_error("a.stl", bytes.substr(0, 84), ": byte 80: 2 faces take 184 bytes, the file has 84");
  expect_error("a.stl", bytes.replace(80, 4, packed<std::uint32_t>({4e9})), ": byte 80: 4000000000 faces take");
  expect_error("a.stl", square_binary_stl("solid").substr(0, 150), ": byte 80: 2 faces take 184 bytes");
}

TEST_F(Hostile_mesh, stl_that_ends_within_the_header_is_refused) {
  expect_error("a.stl", square_binary_stl().substr(0, 83), ": byte 83: the file ends within the header");
  expect_error("a.stl", "x", ": byte 1: the file ends within the header");
}

TEST_F(Hostile_mesh, stl_without_faces_is_refused) {
  expect_error("a.stl", "solid nothing\nendsolid nothing\n", ":2: the file holds no face");
  expect_error("b.stl", std::string(84, '\0'), ": byte 80: the file holds no face");
}

TEST_F(Hostile_mesh, stl_with_a_non_finite_coordinate_is_refused) {
  expect_error("a.stl", changed(square_text_stl, "vertex 1 0 0", "vertex 1 nan 0"), ":5: 'nan' is not a finite number");
  expect_error("a.stl", changed(square_text_stl, "vertex 1 0 0", "vertex 1 0"), ":5: expected 3 coordinates, found 2");
  auto bytes = square_binary_stl();
  bytes.replace(84 + 50 + 12, 4, packed<float>({infinite}));
  expect_error("b.stl", bytes, ": byte 146: face 1 (counted from 0) has a coordinate that is not finite");
}

TEST_F(Hostile_mesh, text_stl_with_a_face_of_two_or_four_corners_is_refused) {
  expect_error("a.stl", changed(square_text_stl, "vertex 1 0 0", "vertex 1 0 0\nvertex 1 0 1"),
               ":8: face 0 (counted from 0) has 4 corners");
  expect_error("a.stl", changed(square_text_stl, "vertex 1 0 0\n", ""), ":6: face 0 (counted from 0) has 2 corners");
}

TEST_F(Hostile_mesh, text_stl_that_is_truncated_or_broken_is_refused) {
  expect_error("a.stl", square_text_stl.substr(0, square_text_stl.find("endsolid")),
               ":15: the file ends where 'endsolid' is expected");
  expect_error("a.stl", square_text_stl.substr(0, 63), ":5: expected 3 coordinates, found 0");
  expect_error("a.stl", changed(square_text_stl, "outer", "inner"), ":3: expected 'outer', found 'inner'");
  expect_error("a.stl", square_text_stl + "rest\n", ":17: expected 'solid', found 'rest'");
}

// The world around

/// A dot between thousands and a decimal comma, as in much of Europe.
struct Comma_punctuation : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Restores the global locale at the end of a test.
struct Locale_guard {
  std::locale before;
  ~Locale_guard() { std::locale::global(before); }
};

TEST_F(Hostile_mesh, a_global_locale_with_another_decimal_separator_never_changes_coordinates) {
  const auto text = folder.write("a.off", changed(square_off, "1 1 0", "1.500 1 0"));
  const auto binary = folder.write("a.stl", square_binary_stl());
  const Locale_guard guard{std::locale()};
  std::locale::global(std::locale(std::locale::classic(), new Comma_punctuation));
  expect_error(text, ": CGAL's reader did not deliver the 4 vertices and 2 faces of the file");
  EXPECT_NO_THROW(read_mesh(binary));
}

}  // namespace
}  // namespace lodestone::test
