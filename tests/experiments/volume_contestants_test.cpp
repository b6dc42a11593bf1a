// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/contact_search.h"
#include "support/temporary_folder.h"
#include "volumes/volume_scene.h"
#include "volumes/walk_counts.h"

namespace lodestone {
namespace {

std::size_t compared = 0;

/// A box that counts how often it is compared.
struct Counted_box {
  static constexpr std::string_view name = "counted";

  Aabb box;

  void enclose(const Leaf_faces& faces) { box.enclose(faces); }
  void enclose(const Counted_box& a, const Counted_box& b) { box.enclose(a.box, b.box); }
  double extent() const { return box.extent(); }
  double volume() const { return box.volume(); }
  Aabb bounds() const { return box; }
  friend bool operator==(const Counted_box&, const Counted_box&) = default;
  friend bool near(const Counted_box& a, const Counted_box& b, double margin) {
    ++compared;
    return near(a.box, b.box, margin);
  }
};

/// A ball of radius 1 with a tree over 8 regions.
template <Bounding_volume Volume>
struct Ball {
  Ball(int frequency, double x) : mesh(icosphere(static_cast<std::size_t>(frequency))), numbering(mesh) {
    for (auto& point : mesh.points()) point = Point(point.x() + x, point.y(), point.z());
    for (const auto& point : mesh.points())
      labels.push_back((point.x() > x ? 1 : 0) + (point.y() > 0 ? 2 : 0) + (point.z() > 0 ? 4 : 0));
    const Moving_mesh moving{&mesh, numbering.corners()};
    object = std::make_unique<Basic_tree_surface<Volume>>(numbering.corners());
    object->build(labels, moving.coordinates(), {});
  }
  const Basic_region_tree<Volume>& tree() const { return object->tree(); }

  Surface_mesh mesh;
  Mesh_numbering<Surface_mesh> numbering;
  std::vector<Region_index> labels;
  std::unique_ptr<Basic_tree_surface<Volume>> object;
};

TEST(Count_walk, counts_the_steps_of_the_search_for_all_contacts) {
  const Ball<Counted_box> a(20, 0), b(25, 1.7);
  const Walk_counts counts = count_walk(a.tree(), b.tree());
  Basic_contact_search<Counted_box> search(Workers::alone());
  std::vector<Face_pair> found;
  compared = 0;
  const auto summary = search.between(*a.object, *b.object, {}, found);
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(counts.leaf_pairs, summary.leaf_tests);
  EXPECT_EQ(counts.volume_tests, compared);
  EXPECT_GT(counts.volume_tests, counts.leaf_pairs);
}

TEST(Count_walk, stops_at_two_roots_that_are_apart) {
  const Ball<Aabb> a(5, 0), b(5, 3);
  const Walk_counts counts = count_walk(a.tree(), b.tree());
  EXPECT_EQ(counts.volume_tests, 1U);
  EXPECT_EQ(counts.leaf_pairs, 0U);
}

class Volume_race : public testing::Test {
 protected:
  /// Two balls that wobble and sink into each other.
  static void SetUpTestSuite() {
    const test::Temporary_folder folder;
    auto scene = read_scene(folder.write("two.json", R"({"frames": 12, "objects": [
      {"name": "left", "shape": {"icosphere": {"frequency": 16}},
       "motion": {"deform": [{"wobble": {"amplitude": 0.05, "waves": 2, "period": 7}}]}},
      {"name": "right", "shape": {"icosphere": {"frequency": 14}},
       "motion": {"deform": [{"wobble": {"amplitude": 0.05, "waves": 1, "period": 5}},
        {"travel": {"path": "linear", "way_points": [{"frame": 0, "at": [2.3, 0, 0]},
          {"frame": 11, "at": [1.5, 0.2, 0]}]}}]}}]})"));
    result = measure_volumes(scene, {.passes = 2}, [](double) {});
  }
  static void TearDownTestSuite() { result = {}; }

  static inline Volume_scene result;
};

TEST_F(Volume_race, every_volume_over_every_partition_gives_the_right_answers) {
  std::set<std::string> strategies;
  ASSERT_EQ(result.contestants.size(), result.race.entries.size());
  EXPECT_GT(result.race.colliding, 0U);
  for (std::size_t place = 0; place < result.contestants.size(); ++place) {
    const auto& contestant = result.contestants[place];
    if (contestant.kind != Contestant_kind::volume) continue;
    EXPECT_TRUE(result.race.entries[place].all_is_right()) << contestant.model << ' ' << contestant.strategy;
    strategies.insert(contestant.strategy);
  }
  EXPECT_EQ(strategies, (std::set<std::string>{"lbg", "lbg_position", "median_split", "vsa"}));
}

TEST_F(Volume_race, every_volume_is_counted_and_measured) {
  for (const auto& contestant : result.contestants) {
    if (contestant.kind != Contestant_kind::volume) continue;
    const auto& figures = *contestant.figures;
    EXPECT_EQ(figures.frames, result.race.sampled.size());
    EXPECT_GE(figures.volume_tests, figures.leaf_pairs);
    EXPECT_GT(figures.exact_tests, 0U);
    EXPECT_GE(figures.exact_tests, result.race.contacts);
    EXPECT_GT(figures.nodes, 2 * division_regions);
    for (const auto& tightness : {figures.first, figures.last}) {
      if (contestant.model == "spherical_shell") continue;  // the only one that is not convex
      EXPECT_GT(tightness.regions, 0);
      for (const double figure : {tightness.leaves, tightness.regions_refitted, tightness.objects})
        EXPECT_GE(figure, 1 - 1e-9) << contestant.model << ' ' << contestant.strategy;
      EXPECT_GE(tightness.regions, 0.95) << contestant.model << ' ' << contestant.strategy;
      if (contestant.model == "aabb" || contestant.model.starts_with("k_dop")) {
        EXPECT_NEAR(tightness.regions, tightness.regions_refitted, 1e-9 * tightness.regions);
      }
    }
  }
}

TEST_F(Volume_race, particles_play_every_frame_up_to_the_last_one_sampled) {
  for (const auto& contestant : result.contestants) {
    if (contestant.kind != Contestant_kind::particles) continue;
    const auto& figures = *contestant.particles;
    // The first frame of a pass is a jump from the end back to the start.
    EXPECT_EQ(figures.frames, 2 * result.race.sampled.back());
    EXPECT_GT(figures.seconds, 0);
  }
}

TEST_F(Volume_race, particles_never_invent_a_collision) {
  std::vector<std::string> models;
  for (std::size_t place = 0; place < result.contestants.size(); ++place) {
    if (result.contestants[place].kind != Contestant_kind::particles) continue;
    models.push_back(result.contestants[place].model);
    EXPECT_EQ(result.race.entries[place].invented, 0U);
    EXPECT_LT(result.race.entries[place].missed, result.race.colliding);
    EXPECT_EQ(result.race.entries[place].frames.size(), result.race.sampled.size());
  }
  EXPECT_EQ(models, (std::vector<std::string>{"particles, 12", "particles, 32", "particles, 64"}));
}

}  // namespace
}  // namespace lodestone
