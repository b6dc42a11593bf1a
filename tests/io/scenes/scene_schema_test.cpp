// SPDX-License-Identifier: GPL-3.0-or-later
// The published schema and the reader must accept the same scenes.

// With sanitizers, g++ 12 warns about std::regex, which valijson uses.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/errors.h"
#include "support/gltf_samples.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

using Json = nlohmann::json;
using nlohmann::literals::operator""_json_pointer;
using Adapter = valijson::adapters::NlohmannJsonAdapter;
namespace fs = std::filesystem;

const fs::path data = LODESTONE_DATA;

using test::read_json;

/// Checks documents against docs/scene.schema.json.
class Scene_schema {
 public:
  Scene_schema() {
    const Json document = read_json(data.parent_path() / "docs" / "scene.schema.json");
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(document), schema_);
  }

  bool accepts(const Json& scene) {
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    return validator.validate(schema_, Adapter(scene), nullptr);
  }

 private:
  valijson::Schema schema_;
};

bool reader_accepts(const std::string& scene) {
  const test::Temporary_folder folder;
  folder.write("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  // Two frames of four vertices, in the PC2 format: 12 characters, version, vertices, start, rate, frames.
  std::string cache("POINTCACHE2\0\1\0\0\0\4\0\0\0\0\0\0\0\0\0\x80\x3f\2\0\0\0", 32);
  folder.write("a.pc2", cache += std::string(96, '\0'));
  // The same in the MDD format: frames, vertices, the time of each frame.
  folder.write("a.mdd", std::string("\0\0\0\2\0\0\0\4", 8) + std::string(8 + 96, '\0'));
  auto animated = test::square_gltf();
  animated.animate(0, "scale", animated.add_numbers({0, 1}), animated.add_points({1, 1, 1, 2, 2, 2}));
  folder.write("a.gltf", animated.gltf());
  for (const std::string name : {"f1.off", "f2.off"}) fs::copy(folder.path() / "a.off", folder.path() / name);
  try {
    read_scene(folder.write("scene.json", scene));
    return true;
  } catch (const Bad_scene&) {
    return false;
  }
}

std::string object(std::string_view keys) {
  return R"({"frames": 2, "objects": [{"name": "a", )" + std::string(keys) + "}]}";
}
std::string shape(std::string_view value) { return object(R"("shape": )" + std::string(value)); }
std::string place(std::string_view value) { return object(R"("mesh": "a.off", "place": )" + std::string(value)); }
std::string motion(std::string_view value) { return object(R"("mesh": "a.off", "motion": )" + std::string(value)); }
std::string deformation(std::string_view value) { return motion(R"({"deform": [)" + std::string(value) + "]}"); }

const std::vector<std::string> good_scenes{
    R"({"objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"name": "n", "description": "d", "frames": 1000000, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"objects": [{"name": "a", "mesh": "a.off", "motion": {"pc2": "a.pc2"}}]})",
    R"({"$schema": "scene.schema.json", "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": []})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a", "a"], ["a", "a"]]})",
    object(R"("mesh": "a.off", "particles": 1)"),
    object(R"("mesh": "a.off", "groups": ["x", "y"], "meets": ["y"])"),
    object(R"("mesh": "a.off", "meets": ["default"])"),
    object(R"("mesh": "a.off", "meets": [])"),
    object(R"("mesh": "a.off", "particles": 100000, "scattered_side": [0, 0, -1])"),
    object(R"("mesh": "a.off", "scattered_side": [1e-300, 0, 0])"),
    shape(R"({"teapot": {}})"),
    shape(R"({"teapot": {"u": 1, "v": 2}})"),
    shape(R"({"uv_sphere": {"slices": 3, "stacks": 2}})"),
    shape(R"({"icosphere": {"frequency": 1}})"),
    shape(R"({"torus_knot": {}})"),
    shape(R"({"torus_knot": {"p": 1, "q": 0, "radius": 0.5, "tube": 0.1, "segments": 3, "sides": 3}})"),
    shape(R"({"cloth": {"columns": 1, "rows": 1}})"),
    place("{}"),
    place(R"({"scale": 0.5, "rotate": {"axis": [0, -1, 0], "degrees": -30}, "translate": [0, 0, 0]})"),
    place(R"({"scale": [1, 2, 3]})"),
    motion(R"({"mdd": "a.mdd"})"),
    object(R"("mesh": "a.gltf")"),
    motion(R"({"gltf": "a.gltf"})"),
    motion(R"({"gltf": {"file": "a.gltf"}})"),
    motion(R"({"gltf": {"file": "a.gltf", "animation": 0, "frames_per_second": 2.5}})"),
    motion(R"({"gltf": {"file": "a.gltf", "animation": "walk"}})"),
    motion(R"({"sequence": ["f1.off", "f2.off"]})"),
    motion(R"({"sequence": "f*.off"})"),
    motion(R"({"sequence": "f#.off"})"),
    motion(R"({"sequence": {"pattern": "f#.off", "first": 1, "last": 2}})"),
    deformation(R"({"wobble": {}}, {"bend": {}}, {"twist": {}}, {"inflate": {}}, {"spin": {}})"),
    deformation(R"({"wobble": {"amplitude": -1, "waves": 0, "period": 0, "phase": -2}})"),
    deformation(R"({"bend": {"axis": [0, 1, 0], "towards": [1, 1, 0], "degrees": 0, "period": 1.5, "phase": 0}})"),
    deformation(R"({"twist": {"axis": [0, 1, 0], "degrees": 1000, "period": 3, "phase": 0.1}})"),
    deformation(R"({"inflate": {"factor": 0.1, "frames": 0.5}})"),
    deformation(R"({"travel": {"way_points": [{"frame": -3, "at": [0, 0, 0]}]}})"),
    deformation(R"({"travel": {"way_points": [{"frame": 0, "at": [0, 0, 0]}, {"frame": 1, "at": [1, 0, 0]},
                                              {"frame": 2, "at": [0, 0, 0]}], "path": "closed"}})"),
    deformation(R"({"spin": {"axis": [0, 0, 1], "degrees_per_frame": -2}})"),
};

const std::vector<std::string> bad_scenes{
    "[]",
    "{}",
    R"({"objects": []})",
    R"({"objects": {}})",
    R"({"objects": [1]})",
    R"({"objects": [{"mesh": "a.off"}]})",
    R"({"objects": [{"name": "a"}]})",
    R"({"objects": [{"name": "", "mesh": "a.off"}]})",
    R"({"objects": [{"name": 1, "mesh": "a.off"}]})",
    R"({"objects": [{"name": "a\nb", "mesh": "a.off"}]})",
    R"({"name": "", "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"$schema": 1, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"description": 7, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"frames": 0, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"frames": 1000001, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"frames": 1.5, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"frames": "2", "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"extra": 1, "objects": [{"name": "a", "mesh": "a.off"}]})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": {}})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": ["a"]})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a"]]})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a", "a", "a"]]})",
    R"({"objects": [{"name": "a", "mesh": "a.off"}], "ignore": [["a", 0]]})",
    object(R"("mesh": "a.off", "shape": {"teapot": {}})"),
    object(R"("mesh": "")"),
    object(R"("mesh": "/a.off")"),
    object(R"("mesh": "a.off\u0000")"),
    object(R"("mesh": "a.off", "extra": 1)"),
    object(R"("mesh": "a.off", "particles": 0)"),
    object(R"("mesh": "a.off", "particles": 100001)"),
    object(R"("mesh": "a.off", "particles": -3)"),
    object(R"("mesh": "a.off", "particles": null)"),
    object(R"("mesh": "a.off", "scattered_side": [0, 0, 0])"),
    object(R"("mesh": "a.off", "scattered_side": [0, 0])"),
    object(R"("mesh": "a.off", "scattered_side": 1)"),
    shape("{}"),
    shape(R"("teapot")"),
    shape(R"({"teapot": {}, "cloth": {"columns": 1, "rows": 1}})"),
    shape(R"({"cube": {}})"),
    shape(R"({"teapot": {"u": 0}})"),
    shape(R"({"teapot": {"v": 201}})"),
    shape(R"({"teapot": {"w": 1}})"),
    shape(R"({"uv_sphere": {"slices": 2, "stacks": 2}})"),
    shape(R"({"uv_sphere": {"slices": 3, "stacks": 1}})"),
    shape(R"({"uv_sphere": {"slices": 2001, "stacks": 2}})"),
    shape(R"({"uv_sphere": {"slices": 3}})"),
    shape(R"({"icosphere": {}})"),
    shape(R"({"icosphere": {"frequency": 401}})"),
    shape(R"({"torus_knot": {"p": 0}})"),
    shape(R"({"torus_knot": {"p": 101}})"),
    shape(R"({"torus_knot": {"q": -1}})"),
    shape(R"({"torus_knot": {"radius": 0}})"),
    shape(R"({"torus_knot": {"tube": 0}})"),
    shape(R"({"torus_knot": {"segments": 2}})"),
    shape(R"({"torus_knot": {"sides": 2001}})"),
    shape(R"({"cloth": {"columns": 0, "rows": 1}})"),
    shape(R"({"cloth": {"columns": 1}})"),
    object(R"("mesh": "a.off", "groups": [])"),
    object(R"("mesh": "a.off", "groups": "x")"),
    object(R"("mesh": "a.off", "groups": [""])"),
    object(R"("mesh": "a.off", "meets": [1])"),
    object(R"("mesh": "a.off", "meets": null)"),
    place("[]"),
    place(R"({"scale": 0})"),
    place(R"({"scale": [1, 1]})"),
    place(R"({"scale": [1, 1, 0]})"),
    place(R"({"scale": "1"})"),
    place(R"({"rotate": {"axis": [0, 0, 1]}})"),
    place(R"({"rotate": {"degrees": 1}})"),
    place(R"({"rotate": {"axis": [0, 0, 0], "degrees": 1}})"),
    place(R"({"rotate": {"axis": [0, 0, 1], "degrees": 1, "extra": 1}})"),
    place(R"({"translate": [0, 0, 0, 0]})"),
    place(R"({"extra": 1})"),
    motion("{}"),
    motion(R"({"pc": "a.pc2"})"),
    motion(R"({"pc2": "a.pc2", "deform": [{"spin": {}}]})"),
    motion(R"({"pc2": 1})"),
    motion(R"({"sequence": []})"),
    motion(R"({"sequence": "f1.off"})"),
    motion(R"({"sequence": [1]})"),
    motion(R"({"sequence": "f*_*.off"})"),
    motion(R"({"sequence": "f#*.off"})"),
    motion(R"({"sequence": "f*.off/f.off"})"),
    motion(R"({"mdd": 1})"),
    motion(R"({"gltf": {"animation": 0}})"),
    motion(R"({"gltf": {"file": "a.gltf", "animation": -1}})"),
    motion(R"({"gltf": {"file": "a.gltf", "animation": null}})"),
    motion(R"({"gltf": {"file": "a.gltf", "frames_per_second": 0}})"),
    motion(R"({"gltf": {"file": "a.gltf", "extra": 1}})"),
    motion(R"({"mdd": "a.mdd", "pc2": "a.pc2"})"),
    motion(R"({"sequence": {"pattern": "f#.off", "first": 1}})"),
    motion(R"({"sequence": {"pattern": "f.off", "first": 1, "last": 2}})"),
    motion(R"({"sequence": {"pattern": "f#_#.off", "first": 1, "last": 2}})"),
    motion(R"({"sequence": {"pattern": "f#.off", "first": -1, "last": 2}})"),
    motion(R"({"sequence": {"pattern": "f#.off", "first": 1, "last": 2000000}})"),
    motion(R"({"deform": []})"),
    motion(R"({"deform": {"spin": {}}})"),
    deformation("{}"),
    deformation(R"({"stretch": {}})"),
    deformation(R"({"spin": {}, "twist": {}})"),
    deformation(R"({"wobble": {"period": -1}})"),
    deformation(R"({"wobble": {"amplitude": "1"}})"),
    deformation(R"({"wobble": {"extra": 1}})"),
    deformation(R"({"bend": {"axis": [0, 0, 0]}})"),
    deformation(R"({"bend": {"towards": [0, 0, 0]}})"),
    deformation(R"({"bend": {"period": -1}})"),
    deformation(R"({"twist": {"axis": [0, 0, 0]}})"),
    deformation(R"({"twist": {"period": -1}})"),
    deformation(R"({"inflate": {"factor": 0}})"),
    deformation(R"({"inflate": {"frames": 0}})"),
    deformation(R"({"travel": {}})"),
    deformation(R"({"travel": {"way_points": []}})"),
    deformation(R"({"travel": {"way_points": [{"frame": 0}]}})"),
    deformation(R"({"travel": {"way_points": [{"at": [0, 0, 0]}]}})"),
    deformation(R"({"travel": {"way_points": [{"frame": 0, "at": [0, 0]}]}})"),
    deformation(R"({"travel": {"way_points": [{"frame": 0, "at": [0, 0, 0], "extra": 1}]}})"),
    deformation(R"({"travel": {"way_points": [{"frame": 0, "at": [0, 0, 0]}], "path": "curly"}})"),
    deformation(R"({"spin": {"axis": [0, 0, 0]}})"),
    deformation(R"({"spin": {"degrees_per_frame": null}})"),
};

TEST(Scene_schema, and_reader_accept_the_same_good_scenes) {
  Scene_schema schema;
  for (const std::string& scene : good_scenes) {
    EXPECT_TRUE(schema.accepts(Json::parse(scene))) << scene;
    EXPECT_TRUE(reader_accepts(scene)) << scene;
  }
}

TEST(Scene_schema, and_reader_refuse_the_same_bad_scenes) {
  Scene_schema schema;
  for (const std::string& scene : bad_scenes) {
    EXPECT_FALSE(schema.accepts(Json::parse(scene))) << scene;
    EXPECT_FALSE(reader_accepts(scene)) << scene;
  }
}

/// Calls `visit` with each object schema inside `schema`.
template <class Visit>
void for_each_object_schema(const Json& schema, const Visit& visit) {
  if (schema.is_object() && schema.contains("properties")) visit(schema);
  if (schema.is_structured())
    for (const Json& part : schema) for_each_object_schema(part, visit);
}

TEST(Scene_schema, describes_every_key_and_closes_every_object) {
  const Json schema = read_json(data.parent_path() / "docs" / "scene.schema.json");
  std::size_t objects = 0;
  for_each_object_schema(schema, [&](const Json& object_schema) {
    ++objects;
    EXPECT_EQ(object_schema.at("additionalProperties"), false) << object_schema.dump();
    for (const auto& [key, value] : object_schema.at("properties").items()) {
      const bool refers = value.contains("$ref");
      EXPECT_TRUE(refers || value.contains("description")) << key;
    }
  });
  EXPECT_GT(objects, 15U);
}

/// Millions of triangles: seconds to make, a minute under a sanitiser.
bool is_huge(const Json& scene) {
  constexpr int frequency = 200;
  return std::ranges::any_of(scene.at("objects"), [](const Json& object) {
    return object.value("/shape/icosphere/frequency"_json_pointer, 0) > frequency;
  });
}

/// Where the vertices of the only object of a scene are in some frames.
std::vector<Point> played(const Json& shape, const Json& deformation) {
  const test::Temporary_folder folder;
  const Json json{
      {"frames", 20},
      {"objects", {{{"name", "a"}, {"shape", shape}, {"motion", {{"deform", Json::array({deformation})}}}}}}};
  Scene scene = read_scene(folder.write("scene.json", json.dump()));
  std::vector<Point> points;
  for (const std::size_t frame : {0, 7, 19}) {
    pose(scene.objects[0], frame);
    points.insert(points.end(), scene.objects[0].mesh.points().begin(), scene.objects[0].mesh.points().end());
  }
  return points;
}

TEST(Scene_schema, the_defaults_that_it_tells_are_those_of_the_reader) {
  const Json schema = read_json(data.parent_path() / "docs" / "scene.schema.json");
  const Json plain_shape{{"torus_knot", Json::object()}}, plain_spin{{"spin", Json::object()}};
  // A wobble and a spin show from which frame on and how fast; way points have no default.
  const Json way_points = Json::parse(R"([{"frame": 0, "at": [0, 0, 0]}, {"frame": 10, "at": [1, 2, 3]},
                                          {"frame": 30, "at": [0, 1, 0]}])");
  std::size_t defaults = 0;
  for (const auto* kind : {"shape", "deformation"})
    for (const auto& [name, described] : schema["definitions"][kind]["properties"].items()) {
      Json plain = Json::object();
      if (name == "travel") plain["way_points"] = way_points;
      if (!described.contains("properties") || name == "icosphere") continue;
      for (const auto& [property, about] : described["properties"].items()) {
        if (!about.contains("default")) continue;
        Json told = plain;
        told[property] = about["default"];
        const bool is_shape = std::string_view(kind) == "shape";
        const auto with = [&, described_name = name](const Json& given) {
          return is_shape ? played({{described_name, given}}, plain_spin)
                          : played(plain_shape, {{described_name, given}});
        };
        EXPECT_EQ(with(told), with(plain)) << name << ' ' << property;
        ++defaults;
      }
    }
  EXPECT_GE(defaults, 26U);
}

class Published_scenes : public testing::TestWithParam<fs::path> {};

TEST_P(Published_scenes, follow_the_schema_and_can_be_played) {
  const Json json = read_json(GetParam());
  EXPECT_TRUE(Scene_schema().accepts(json));
  if (is_huge(json)) return;
  Scene scene = read_scene(GetParam());
  EXPECT_EQ(scene.name, GetParam().stem());
  for (Scene_object& object : scene.objects)
    for (const std::size_t frame : {std::size_t{0}, scene.frames - 1}) EXPECT_NO_THROW(pose(object, frame));
}

std::vector<fs::path> published_scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(data / "scenes"))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Data, Published_scenes, testing::ValuesIn(published_scenes()),
                         [](const auto& scene) { return scene.param.stem().string(); });

}  // namespace
}  // namespace lodestone
