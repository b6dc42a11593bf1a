// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/rival.h"

#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"

namespace lodestone {

namespace {

/// One detector for each of the two questions.
class Detector_rival : public Rival {
 public:
  Detector_rival(Character_scene& scene, Mode mode)
      : scene_(scene), mode_(mode), any_({.mode = mode, .contacts = Contact_query::yes_no}), all_({.mode = mode}) {
    for (auto* detector : {&any_, &all_})
      for (const auto& character : scene.characters) add(*detector, character);
  }

  std::optional<bool> any() override { return ask(any_).collides(); }
  bool all(std::vector<Face_pair>& found) override {
    found = ask(all_).face_pairs;
    return true;
  }

 private:
  /// Mode `exact` reads the meshes; the others read positions on demand.
  void add(Detector<>& detector, const Character& character) const {
    if (mode_ == Mode::exact)
      detector.add(character.mesh);
    else
      detector.add(character.mesh, point_map(character.mesh, character.points));
  }
  const Frame& ask(Detector<>& detector) {
    if (mode_ == Mode::exact) pose_meshes(scene_);
    if (mode_ == Mode::particles) detector.update();
    return detector.detect();
  }

  Character_scene& scene_;
  Mode mode_;
  Detector<> any_, all_;
};

Rival_kind detector_kind(std::string name, Mode mode, std::size_t most_triangles = 0) {
  return {.name = std::move(name),
          .lists_pairs = mode != Mode::particles,
          .most_triangles = most_triangles,
          .make = [mode](Character_scene& scene) -> std::unique_ptr<Rival> {
            return std::make_unique<Detector_rival>(scene, mode);
          }};
}

}  // namespace

void pose_meshes(Character_scene& scene) {
  static_assert(sizeof(Point) == 3 * sizeof(double));
  for (auto& character : scene.characters) {
    Point& first = character.mesh.point(Surface_mesh::Vertex_index(0));
    character.points.pose_all({reinterpret_cast<double*>(&first), 3 * std::size_t{character.points.vertex_count()}});
  }
}

std::vector<Rival_kind> rival_kinds() {
  // The partition of a million triangles takes minutes.
  return {detector_kind("certified", Mode::certified), detector_kind("pose everything + exact", Mode::exact),
          detector_kind("particles", Mode::particles, 600'000)};
}

}  // namespace lodestone
