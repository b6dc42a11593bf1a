// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/results/coloured_ply.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/errors.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

/// A vertex as stored in the file.
struct Written_vertex {
  std::array<double, 3> position;
  std::array<std::uint8_t, 3> colour;
  std::int32_t region;
};

std::vector<Written_vertex> written_vertices(const std::filesystem::path& file, std::size_t count) {
  const std::string bytes = read_bytes(file);
  auto at = bytes.find("end_header\n") + 11;
  const auto take = [&](void* value, std::size_t size) {
    std::memcpy(value, bytes.substr(at, size).data(), size);
    at += size;
  };
  std::vector<Written_vertex> vertices(count);
  for (auto& vertex : vertices) {
    take(vertex.position.data(), 24);
    take(vertex.colour.data(), 3);
    take(&vertex.region, 4);
  }
  return vertices;
}

/// A sphere of frequency 3: 92 vertices, 180 faces; vertex v is in region v.
class Coloured_ply : public testing::Test {
 protected:
  Coloured_ply() {
    for (Region_index v = 0; v < mesh.number_of_vertices(); ++v) regions.push_back(v);
  }
  Temporary_folder folder;
  std::filesystem::path file = folder.path() / "sphere.ply";
  Surface_mesh mesh = icosphere(3);
  std::vector<Region_index> regions;
};

TEST_F(Coloured_ply, is_read_back_as_the_same_mesh) {
  write_coloured_ply(file, mesh, regions);
  const auto copy = read_mesh(file).mesh;
  ASSERT_EQ(copy.number_of_vertices(), 92U);
  ASSERT_EQ(copy.number_of_faces(), 180U);
  for (const auto v : mesh.vertices()) EXPECT_EQ(copy.point(v), mesh.point(v));
  for (const auto f : mesh.faces()) {
    std::set<std::uint32_t> before, after;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) before.insert(v);
    for (const auto v : copy.vertices_around_face(copy.halfedge(f))) after.insert(v);
    EXPECT_EQ(after, before);
  }
}

TEST_F(Coloured_ply, stores_the_region_of_each_vertex) {
  for (auto& region : regions) region %= 7;
  write_coloured_ply(file, mesh, regions);
  const auto vertices = written_vertices(file, 92);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_EQ(vertices[v].region, static_cast<std::int32_t>(v % 7));
    EXPECT_EQ(vertices[v].colour, vertices[v % 7].colour);
  }
}

TEST_F(Coloured_ply, regions_with_consecutive_indices_have_colours_far_apart) {
  write_coloured_ply(file, mesh, regions);
  const auto vertices = written_vertices(file, 92);
  for (std::size_t a = 0; a < vertices.size(); ++a)
    for (std::size_t b = a + 1; b < std::min(a + 4, vertices.size()); ++b) {
      double squared_distance = 0;
      for (int i = 0; i < 3; ++i) {
        const double difference = vertices[a].colour[i] - vertices[b].colour[i];
        squared_distance += difference * difference;
      }
      EXPECT_GT(squared_distance, 50.0 * 50.0) << a << " and " << b;
    }
}

TEST_F(Coloured_ply, appears_whole_or_not_at_all) {
  create_directory(file);
  EXPECT_THROW(write_coloured_ply(file, mesh, regions), Bad_output);
  EXPECT_TRUE(is_empty(file));
  const auto blocked = folder.write("blocked", "mine") / "sphere.ply";
  EXPECT_THROW(write_coloured_ply(blocked, mesh, regions), Bad_output);
  EXPECT_EQ(file_size(folder.path() / "blocked"), 4U);
}

TEST_F(Coloured_ply, an_empty_mesh_gives_a_file_without_elements) {
  write_coloured_ply(file, Surface_mesh(), {});
  std::ifstream in(file);
  std::string line;
  std::vector<std::string> lines;
  while (std::getline(in, line)) lines.push_back(line);
  EXPECT_EQ(lines.front(), "ply");
  EXPECT_EQ(lines.back(), "end_header");
}

}  // namespace
}  // namespace lodestone::test
