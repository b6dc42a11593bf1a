// SPDX-License-Identifier: GPL-3.0-or-later
// A scene in a folder with a mesh, `mesh.off`, and a point cache of two frames that fits it, `mesh.pc2`.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "fuzz/read_input.h"
#include "fuzz/scratch_folder.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/io/scenes/separated_objects.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Scene;
using Json = nlohmann::json;

void write_neighbours() {
  scratch().write("mesh.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  // Signature, version 1, 4 vertices, from frame 0 at rate 1, 2 frames; all coordinates are zero.
  std::string cache("POINTCACHE2\0\1\0\0\0\4\0\0\0\0\0\0\0\0\0\200\77\2\0\0\0", 32);
  cache.resize(32 + std::size_t{2} * 4 * 12);
  scratch().write("mesh.pc2", cache);
}

/// Large shapes are legal, and would only take time.
bool is_small(const Json& json) {
  constexpr std::string_view sizes[] = {"u", "v",    "slices",  "stacks", "frequency", "p",
                                        "q", "rows", "columns", "sides",  "segments"};
  constexpr std::size_t most_elements = 12;
  constexpr double largest = 40;
  if (json.is_array() && json.size() > most_elements) return false;
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(sizes, key) != std::end(sizes) && value.is_number() && value.get<double>() > largest)
      return false;
    if (value.is_structured() && !is_small(value)) return false;
  }
  return true;
}

void check_scene(Scene& scene) {
  require(!scene.objects.empty() && scene.frames > 0, "a scene without objects or frames");
  for (auto& object : scene.objects) {
    require(object.mesh.is_valid(false), "an object of the scene is invalid");
    check_motion(object.motion, object.file_vertices);
    accepts([&] { pose(object, scene.frames - 1); });
  }
}

std::size_t count_faces(const Scene& scene) {
  std::size_t count = 0;
  for (const auto& object : scene.objects) count += object.mesh.number_of_faces();
  return count;
}

void check_separated(Scene& scene, lodestone::Separate what) {
  const std::size_t objects = scene.objects.size(), faces = count_faces(scene);
  lodestone::separate(scene, what);
  require(scene.objects.size() >= objects && count_faces(scene) == faces, "objects without faces of the whole");
  check_scene(scene);
}

bool nests_little(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return c == '[' || c == '{'; }) < 1000;
}

}  // namespace

LODESTONE_FUZZ_TARGET(scene) {
  static const bool written = (write_neighbours(), true);
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  if (!written || (nests_little(text) && !is_small(Json::parse(text, nullptr, false)))) return;
  const auto file = scratch().write("scene.json", input);
  accepts([&] {
    auto scene = lodestone::read_scene(file);
    check_scene(scene);
    check_separated(scene, lodestone::Separate::parts);
    check_separated(scene, lodestone::Separate::components);
  });
}
