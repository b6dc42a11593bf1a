// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "io/motion/damaged_animations.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/temporary_folder.h"
#include "support/vandal.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// Every value inside a document, including objects and arrays.
std::vector<Json::json_pointer> all_places(const Json& document) {
  std::set<std::string> places;
  const auto leaves = document.flatten();
  for (const auto& [place, ignored] : leaves.items())
    for (Json::json_pointer pointer(place); !pointer.empty(); pointer = pointer.parent_pointer())
      places.insert(pointer.to_string());
  std::vector<Json::json_pointer> result;
  for (const auto& place : places) result.emplace_back(place);
  return result;
}

class Gltf_damage : public Damaged_animations {
 protected:
  void expect_error(const std::string& content, const std::string& part) const {
    const auto file = folder.write("a.gltf", content);
    try {
      read_mesh(file);
      ADD_FAILURE() << "expected " << part;
    } catch (const Bad_mesh& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string())) << error.what();
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  /// The rich sample with the value at a JSON pointer changed.
  void expect_error(const std::string& pointer, const Json& value, const std::string& part) const {
    auto sample = rich_gltf();
    sample.json[Json::json_pointer(pointer)] = value;
    expect_error(sample.gltf(), part);
  }
};

TEST_F(Gltf_damage, a_file_truncated_at_any_byte_is_an_error) {
  const auto whole = rich_gltf().glb();
  for (std::size_t length = 0; length < whole.size(); ++length)
    read_all(folder.write("a.glb", whole.substr(0, length)));
  EXPECT_EQ(good, 0U);
  const auto text = rich_gltf().gltf();
  for (std::size_t length = 0; length < text.size(); length += 3)
    read_all(folder.write("a.gltf", text.substr(0, length)));
  EXPECT_EQ(good, 0U);
  read_all(folder.write("a.glb", whole));
  read_all(folder.write("a.gltf", text));
  EXPECT_EQ(good, 2U);
}

TEST_F(Gltf_damage, any_wrong_byte_gives_a_mesh_or_an_error) {
  const auto whole = rich_gltf().glb();
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const unsigned flip : {0x01U, 0x80U, 0xffU}) {
      auto bytes = whole;
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ flip);
      read_all(folder.write("a.glb", bytes));
    }
  EXPECT_GT(good, 500U);
  EXPECT_GT(bad, 500U);
}

TEST_F(Gltf_damage, any_replaced_value_gives_a_mesh_or_an_error) {
  const auto sample = rich_gltf();
  const std::vector<Json> others{
      -1,    0,   1,  2,   3,       4,    255,           65536,          2147483647,       4294967295U,        1e18,
      1e300, 0.5, "", "x", nullptr, true, Json::array(), Json::object(), Json::array({0}), Json::array({1, 1})};
  const auto places = all_places(sample.json);
  for (const auto& place : places) {
    read_all(folder.write("a.gltf", sample.gltf()));
    for (const auto& other : others) {
      auto changed = sample;
      changed.json[place] = other;
      read_all(folder.write("a.gltf", changed.gltf()));
    }
    auto without = sample;
    auto& parent = without.json[place.parent_pointer()];
    if (parent.is_object())
      parent.erase(place.back());
    else
      parent.erase(static_cast<Json::size_type>(std::stoul(place.back())));
    read_all(folder.write("a.gltf", without.gltf()));
  }
  EXPECT_GT(good, places.size());  // complete files, and some for which a value is optional or arbitrary
  EXPECT_GT(bad, 1000U);
}

TEST_F(Gltf_damage, random_damage_gives_a_mesh_or_an_error) {
  Vandal vandal;
  for (int round = 0; round < 1500; ++round) {
    read_all(folder.write("a.glb", vandal.damaged(rich_gltf().glb())));
    read_all(folder.write("a.gltf", vandal.damaged(rich_gltf().gltf())));
  }
  EXPECT_GT(bad, 1000U);
}

TEST_F(Gltf_damage, a_short_file_that_describes_too_many_numbers_is_refused) {
  auto sample = square_gltf();
  auto& primitive = sample.json["meshes"][0]["primitives"][0];
  for (int target = 0; target < 100'000; ++target) primitive["targets"].push_back(primitive["attributes"]);
  const auto file = folder.write("a.gltf", sample.gltf());
  try {
    read_mesh(file, {.max_faces = 1000});
    ADD_FAILURE() << "expected an error";
  } catch (const Bad_mesh& error) {
    EXPECT_EQ(error.what(), file.string() +
                                ": the shown meshes and the animations have 1200030 numbers, where at most "
                                "1000000 are allowed");
  }
}

TEST_F(Gltf_damage, wrong_sizes_in_the_container_are_refused) {
  const auto glb = square_gltf().glb();
  const auto changed = [&](std::size_t at, double value) {
    return std::string(glb).replace(at, 4, packed<std::uint32_t>({value}));
  };
  expect_error(glb.substr(0, 11), ": byte 11: the file ends within the header");
  expect_error(changed(4, 1), ": byte 4: expected version 2, found 1");
  expect_error(changed(8, 4e9), ": byte 8: 4000000000 bytes are announced, the file has ");
  expect_error(changed(12, 4e9), ": byte 12: a chunk of 4000000000 bytes does not fit into the ");
  expect_error(changed(16, 7), ": byte 12: expected a chunk of JSON");
  expect_error("", ": the file is empty");
  expect_error("[]", "/: expected an object");
  expect_error(std::string(1000, '['), "nested deeper");
}

TEST_F(Gltf_damage, counts_too_large_for_the_file_are_refused) {
  expect_error("/accessors/0/count", 4'000'000, "/accessors/0: 4000000 elements of 12 bytes from byte 0 on do not fit");
  expect_error("/accessors/0/byteOffset", 44, "/accessors/0: 4 elements of 12 bytes from byte 44 on");
  expect_error("/accessors/3/count", 2'000'000'000,
               "/accessors/3: has 2000000000 elements, more than any stored accessor has");
  expect_error("/bufferViews/0/byteLength", 1'000'000, "/bufferViews/0/byteLength: 1000000 is not a whole number");
  expect_error("/bufferViews/1/byteLength", 450,
               "/bufferViews/1: 450 bytes from byte 48 on do not fit into the buffer of");
  expect_error("/accessors/3/sparse/count", 5, "/accessors/3/sparse/count: 5 is not a whole number from 1 to 4");
  expect_error("/accessors/3/sparse/values/byteOffset", 4, "/accessors/3/sparse/values: 2 elements of 12 bytes");
}

TEST_F(Gltf_damage, buffers_that_are_too_long_together_are_refused_before_they_are_read) {
  auto document = Json::parse(rich_gltf().gltf());
  document["buffers"].push_back({{"byteLength", std::size_t{1} << 34U}, {"uri", "missing.bin"}});
  expect_error(document.dump(), "/buffers/1: the buffers up to this one have ");
  document["buffers"][1]["byteLength"] = std::size_t{1} << 33U;
  expect_error(document.dump(), "there is no such file");
}

TEST_F(Gltf_damage, sparse_indices_must_be_in_order_and_below_the_number_of_elements) {
  const auto with_indices = [](std::initializer_list<double> indices) {
    auto sample = rich_gltf();
    const auto view = sample.add_view(packed<std::uint16_t>(indices));
    sample.json["accessors"][3]["sparse"]["indices"]["bufferView"] = view;
    return sample.gltf();
  };
  EXPECT_NO_THROW(read_mesh(folder.write("right.gltf", with_indices({0, 3}))));
  expect_error(with_indices({0, 4}), "sparse index 4 is out of order, or not below 4");
  expect_error(with_indices({3, 3}), "sparse index 3 is out of order, or not below 4");
  expect_error(with_indices({3, 2}), "sparse index 2 is out of order, or not below 4");
}

TEST_F(Gltf_damage, a_scene_where_there_are_none_is_refused) {
  auto sample = rich_gltf();
  sample.json.erase("scenes");
  expect_error(sample.gltf(), "/scene: refers to one of the scenes, but there are none");
}

TEST_F(Gltf_damage, dangling_references_are_refused) {
  expect_error("/meshes/0/primitives/0/indices", 99, "/meshes/0/primitives/0/indices: 99 is not a whole number");
  expect_error("/nodes/0/mesh", 1, "/nodes/0/mesh: 1 is not a whole number from 0 to 0");
  expect_error("/nodes/0/children/0", 3, "/nodes/0/children/0: 3 is not");
  expect_error("/skins/0/joints/1", -1, "/skins/0/joints/1: -1 is not");
  expect_error("/animations/0/channels/0/sampler", 9, "/animations/0/channels/0/sampler: 9 is not");
  expect_error("/scene", 1, "/scene: 1 is not");
  auto sample = square_gltf();
  sample.json["meshes"][0]["primitives"][0]["indices"] = sample.add_indices({0, 1, 4});
  expect_error(sample.gltf(), "/meshes/0/primitives/0: index 2 (counted from 0) refers to vertex 4 of 4");
}

TEST_F(Gltf_damage, joints_that_a_skin_does_not_have_are_refused) {
  auto sample = rich_gltf();
  sample.json["skins"][0]["joints"] = {1};
  expect_error(sample.gltf(), ": a vertex follows joint 1 (counted from 0), but /skins/0 has 1");
}

TEST_F(Gltf_damage, negative_joint_weights_are_refused) {
  auto sample = rich_gltf();
  const auto weights = sample.add_quaternions({1, 0, 0, 0, 1.5, -0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  sample.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
  expect_error(sample.gltf(), "/meshes/0/primitives/0: vertex 1 (counted from 0) has a negative joint weight");
}

TEST_F(Gltf_damage, matrices_that_are_not_affine_are_refused) {
  for (const double w : {2.0, 0.0}) {
    auto sample = square_gltf();
    sample.json["nodes"][0]["matrix"] = Json{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, w};
    expect_error(sample.gltf(), "/nodes/0: the last row of the matrix is not 0, 0, 0, 1");
  }
  auto bound = rich_gltf();
  bound.json["skins"][0]["inverseBindMatrices"] =
      bound.add_floats("MAT4", 16, {1, 0, 0, 0,   0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                    1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  expect_error(bound.gltf(), "/skins/0: joint 1: the last row of the matrix is not 0, 0, 0, 1");
  auto rounded = square_gltf();
  rounded.json["nodes"][0]["matrix"] = Json{1, 0, 0, 1e-7, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1 - 1e-7};
  EXPECT_EQ(read_mesh(folder.write("rounded.gltf", rounded.gltf())).mesh.number_of_faces(), 2U);
}

TEST_F(Gltf_damage, nodes_in_cycles_or_with_two_parents_are_refused) {
  expect_error("/nodes/2/children", {1}, "/nodes/1: is a child of node 0 and of node 2");
  expect_error("/nodes/2/children", {0}, "the nodes form a cycle");
  expect_error("/nodes/1/children", {1}, "/nodes/1: is a child of node 0 and of node 1");
}

TEST_F(Gltf_damage, a_deep_node_tree_does_not_overflow_the_stack) {
  auto sample = square_gltf();
  sample.json["nodes"] = Json::array();
  for (int i = 0; i < 50'000; ++i) sample.json["nodes"].push_back({{"children", {i + 1}}});
  sample.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(read_mesh(folder.write("a.gltf", sample.gltf())).mesh.number_of_faces(), 2U);
}

TEST_F(Gltf_damage, an_extension_that_leaves_out_buffers_is_named) {
  auto document = Json::parse(square_gltf().gltf());
  document["extensionsRequired"] = {"EXT_meshopt_compression"};
  document["buffers"].push_back({{"byteLength", 99}});
  expect_error(document.dump(), "/extensionsRequired/0: the extension \"EXT_meshopt_compression\" is not supported");
}

TEST_F(Gltf_damage, values_of_the_wrong_kind_are_refused) {
  expect_error("/accessors/1/componentType", 5122, "expected an accessor of unsigned integers");
  expect_error("/nodes/1/rotation", {0, 0, 0, 0}, "/nodes/1: the rotation has no direction");
  expect_error("/meshes/0/weights", {1}, "/meshes/0/weights: has 1 weights for 2 morph targets");
  expect_error("/extensionsRequired", {"KHR_draco_mesh_compression"}, "KHR_draco_mesh_compression\" is not supported");
  expect_error("/asset/version", "1.0", "/asset/version: expected 2.0");
  expect_error("/asset/minVersion", "2.1", "/asset/minVersion: expected 2.0, found \"2.1\"");
  auto sample = square_gltf();
  const double infinite = std::numeric_limits<double>::infinity();
  sample.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      sample.add_points({0, 0, 0, 1, 0, 0, 1, 1, infinite, 0, 0, 0});
  expect_error(sample.gltf(), "/accessors/2: element 2 (counted from 0) is not finite");
  auto times = square_gltf();
  times.animate(0, "translation", times.add_numbers({1, 1}), times.add_points({0, 0, 0, 1, 0, 0}));
  expect_error(times.gltf(), ": time 1 (counted from 0) is not after the one before");
  auto keys = square_gltf();
  keys.animate(0, "translation", keys.add_numbers({0, 1}), keys.add_points({0, 0, 0}));
  expect_error(keys.gltf(), "2 times need 2 keys, found 1");
}

TEST_F(Gltf_damage, elements_that_overlap_in_their_buffer_view_are_refused) {
  auto sample = square_gltf();
  const std::size_t view = sample.json["accessors"][0]["bufferView"];
  sample.json["bufferViews"][view]["byteStride"] = 8;
  expect_error(sample.gltf(), "/accessors/0: elements of 12 bytes are 8 bytes apart in the buffer view");
  sample.json["bufferViews"][view]["byteStride"] = 12;
  EXPECT_EQ(read_mesh(folder.write("a.gltf", sample.gltf())).mesh.number_of_faces(), 2U);
}

TEST_F(Gltf_damage, a_mesh_without_a_copy_that_is_not_compressed_is_refused) {
  auto sample = square_gltf();
  auto& primitive = sample.json["meshes"][0]["primitives"][0];
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  EXPECT_EQ(read_mesh(folder.write("a.gltf", sample.gltf())).mesh.number_of_faces(), 2U);
  sample.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()].erase("bufferView");
  expect_error(sample.gltf(), "/meshes/0/primitives/0: is stored by KHR_draco_mesh_compression alone");
}

TEST_F(Gltf_damage, two_channels_with_one_target_are_refused) {
  auto sample = square_gltf();
  const auto times = sample.add_numbers({0, 1});
  sample.animate(0, "translation", times, sample.add_points({0, 0, 0, 1, 0, 0}));
  sample.animate(0, "scale", times, sample.add_points({1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(read_mesh(folder.write("a.gltf", sample.gltf())).mesh.number_of_faces(), 2U);
  sample.animate(0, "translation", times, sample.add_points({0, 0, 0, 0, 1, 0}));
  expect_error(sample.gltf(),
               "/animations/0/channels/2/target: another channel of the animation has the same target, the "
               "translation of node 0");
}

TEST_F(Gltf_damage, buffers_stay_in_the_folder) {
  const Temporary_folder other;
  const auto sample = square_gltf();
  const auto outside = other.write("a.bin", sample.bytes);
  create_symlink(outside, folder.path() / "link.bin");
  for (const auto& uri : {outside.string(), "../" + other.path().filename().string() + "/a.bin",
                          std::string("link.bin"), "%2e%2e/" + other.path().filename().string() + "/a.bin",
                          "file://" + outside.string(), std::string("https://example.org/a.bin"), std::string("%00")})
    expect_error(sample.gltf(uri), "is not a file inside the folder");
  expect_error(sample.gltf("none.bin"), "none.bin': there is no such file");
  create_directory(folder.path() / "folder.bin");
  expect_error(sample.gltf("folder.bin"), "this is not a regular file");
  folder.write("short.bin", sample.bytes.substr(1));
  expect_error(sample.gltf("short.bin"), "the file is shorter than the 60 bytes of its buffer");
}

TEST_F(Gltf_damage, data_uris_are_base64_of_any_media_type) {
  const auto sample = square_gltf();
  for (const std::string uri : {"data:application/octet-stream;base64,", "data:;base64,", "data:a/b;c=d;base64,"}) {
    expect_error(sample.gltf(uri + "AAAA"), "the data URI is too short");
    expect_error(sample.gltf(uri + std::string(80, '!')), "60 bytes are announced, the data URI has 0");
  }
  for (const std::string uri : {"data:text/plain,hello", "data:", "data:;base64", "data:application/octet-stream;AAAA"})
    expect_error(sample.gltf(uri), "expected a data URI in base64");
}

TEST_F(Gltf_damage, a_short_file_cannot_exhaust_memory) {
  auto sample = square_gltf();
  sample.json["nodes"] = Json::array();
  for (int i = 0; i < 100; ++i) {
    sample.json["nodes"].push_back({{"mesh", 0}});
    sample.json["scenes"][0]["nodes"][static_cast<std::size_t>(i)] = i;
  }
  const auto file = folder.write("a.gltf", sample.gltf());
  EXPECT_EQ(read_mesh(file).mesh.number_of_faces(), 200U);
  EXPECT_THROW(read_mesh(file, {.max_faces = 199}), Bad_mesh);
}

}  // namespace
}  // namespace lodestone::test
