// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

/// The unit square of the plane z = 0 as two triangles, in every format. Vertices (0 0 0) (1 0 0) (1 1 0) (0 1 0),
/// faces 0 1 2 and 0 2 3.
namespace lodestone::test {

/// The bytes of `values`, each converted to T.
template <class T>
std::string packed(std::initializer_list<double> values, std::endian order = std::endian::little) {
  std::string bytes;
  for (const double value : values) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(static_cast<T>(value));
    if (order != std::endian::native) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

inline const std::string square_off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

inline const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

inline std::string square_ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string square_ply() {
  return square_ply_header("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
}

inline std::string square_ply(std::endian order) {
  return square_ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian") +
         packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, order) + '\3' + packed<std::int32_t>({0, 1, 2}, order) +
         '\3' + packed<std::int32_t>({0, 2, 3}, order);
}

inline const std::string square_text_stl =
    "solid square\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid square\n";

inline std::string square_binary_stl(const std::string& comment = "square") {
  auto header = comment;
  header.resize(80);
  return header + packed<std::uint32_t>({2}) + packed<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0}) +
         packed<std::uint16_t>({0}) + packed<float>({0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}) + packed<std::uint16_t>({0});
}

struct Sample {
  std::string name, bytes;
};

inline std::vector<Sample> all_squares() {
  return {{"square.off", square_off},
          {"square.obj", square_obj},
          {"text.ply", square_ply()},
          {"little.ply", square_ply(std::endian::little)},
          {"big.ply", square_ply(std::endian::big)},
          {"text.stl", square_text_stl},
          {"binary.stl", square_binary_stl()}};
}

}  // namespace lodestone::test
