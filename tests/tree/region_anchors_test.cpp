// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/region_anchors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/saved_state.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

/// An object with the regions of its octants, and where it is now. Not movable, since the tree refers to the positions.
class Anchored_object {
 public:
  explicit Anchored_object(const Face_soup& rest) : Anchored_object(rest, octants(rest)) {}
  Anchored_object(const Face_soup& rest, std::vector<Region_index> labels)
      : rest_(rest),
        now_(rest),
        labels_(std::move(labels)),
        tree_(rest.faces, labels_, rest.coordinates, {.leaf_faces = 16}) {
    tree_.start_frame(Live_positions(rest_.coordinates.data()));
    regions_ = Region_anchors(tree_, rest_.faces, labels_, rest_.coordinates);
  }
  Anchored_object(const Anchored_object&) = delete;
  Anchored_object& operator=(const Anchored_object&) = delete;

  void move_to(const Face_soup& now, double reach = 1) {
    now_ = now;
    tree_.start_frame(Live_positions(now_.coordinates.data()));
    regions_.read(tree_, reach);
  }
  void find(const Face_soup& now, double reach = 1) {
    now_ = now;
    tree_.start_frame(Live_positions(now_.coordinates.data()));
    regions_.find(tree_, reach);
  }
  void find_regions() { regions_.find_regions(tree_, 1); }
  const Face_soup& rest() const { return rest_; }
  const Face_soup& now() const { return now_; }
  const Region_anchors& regions() const { return regions_; }
  Tree_on_demand& tree() { return tree_; }
  /// The region with which the tree groups a face.
  Region_index region_of(std::uint32_t face) const {
    const auto& [a, b, c] = rest_.faces[face];
    return std::min({labels_[a], labels_[b], labels_[c]});
  }

 private:
  Face_soup rest_, now_;
  std::vector<Region_index> labels_;
  Tree_on_demand tree_;
  Region_anchors regions_;
};

using Region_pairs = std::set<std::pair<Region_index, Region_index>>;

Region_pairs listed_pairs(const Anchored_object& a, const Anchored_object& b) {
  std::vector<Near_regions> near;
  list_near_regions(a.regions(), b.regions(), near);
  Region_pairs pairs;
  for (const auto& pair : near) pairs.emplace(a.regions().region(pair.a), b.regions().region(pair.b));
  EXPECT_EQ(pairs.size(), near.size()) << "a pair is listed twice";
  return pairs;
}

void expect_box_around(const Anchored_object& object) {
  for (std::uint32_t v = 0; v < object.now().vertex_count(); ++v) {
    const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(object.now().coordinates.data() + 3 * std::size_t{v});
    EXPECT_LE(object.regions().box().exteriorDistance(p), 1e-12 * (1 + p.norm()));
  }
}

TEST(Region_anchors, list_each_region_with_all_its_faces_once) {
  for (const auto& [name, soup] : small_objects()) {
    Anchored_object object(soup);
    const Tree_layout& layout = object.tree().layout();
    std::set<std::uint32_t> faces;
    std::set<Region_index> regions;
    for (std::uint32_t place = 0; place < object.regions().size(); ++place) {
      EXPECT_TRUE(regions.insert(object.regions().region(place)).second);
      const auto& node = layout.node(object.regions().node(place));
      for (std::uint32_t leaf = node.leaf; leaf < node.end_leaf; ++leaf)
        for (const auto face : layout.faces(leaf)) {
          EXPECT_TRUE(faces.insert(face).second);
          EXPECT_EQ(object.region_of(face), object.regions().region(place)) << name;
        }
    }
    EXPECT_EQ(faces.size(), soup.faces.size()) << name;
  }
}

TEST(Region_anchors, regions_whose_faces_intersect_are_listed_wherever_and_however_large_the_objects_are) {
  std::mt19937_64 random(5);
  const auto objects = small_objects();
  std::size_t meeting = 0, apart = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Anchored_object a(objects[i].second), b(objects[(i + 2) % objects.size()].second);
    for (const double factor : {1.0, 3.0})
      for (int pose = 0; pose < 6; ++pose) {
        a.move_to(placed(posed_at_random(a.rest(), 0.8, random), factor));
        b.move_to(placed(posed_at_random(b.rest(), 0.8, random), factor));
        const auto listed = listed_pairs(a, b);
        Region_pairs expected;
        for (const auto& [face_a, face_b] : true_pairs(a.now(), b.now()))
          expected.emplace(a.region_of(face_a), b.region_of(face_b));
        EXPECT_TRUE(std::ranges::includes(listed, expected)) << objects[i].first;
        meeting += expected.size();
        apart += a.regions().size() * b.regions().size() - listed.size();
      }
  }
  EXPECT_GT(meeting, 100U);
  EXPECT_GT(apart, 100U);
}

/// Every coordinate along one axis multiplied.
Face_soup pulled(Face_soup soup, std::size_t axis, double factor) {
  for (std::size_t i = axis; i < soup.coordinates.size(); i += 3) soup.coordinates[i] *= factor;
  return soup;
}

TEST(Region_anchors, regions_whose_faces_intersect_are_listed_where_objects_are_pulled_in_one_direction) {
  std::mt19937_64 random(7);
  const auto objects = small_objects();
  std::size_t meeting = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    SCOPED_TRACE(objects[i].first);
    Anchored_object a(objects[i].second), b(objects[(i + 2) % objects.size()].second);
    for (const std::size_t axis : {0, 1, 2})
      for (const double factor : {1.5, 2.0, 4.0}) {
        a.move_to(pulled(a.rest(), axis, factor));
        b.move_to(posed_at_random(b.rest(), factor, random));
        Region_pairs expected;
        for (const auto& [face_a, face_b] : true_pairs(a.now(), b.now()))
          expected.emplace(a.region_of(face_a), b.region_of(face_b));
        EXPECT_TRUE(std::ranges::includes(listed_pairs(a, b), expected));
        meeting += expected.size();
      }
  }
  EXPECT_GT(meeting, 50U);
}

TEST(Region_anchors, an_object_of_a_single_region_stretches_too) {
  for (const auto& [name, soup] : small_objects()) {
    SCOPED_TRACE(name);
    Anchored_object object(soup, std::vector<Region_index>(soup.vertex_count(), 0));
    object.move_to(placed(soup, 3));
    EXPECT_NEAR(object.tree().stretch(), 3, 1e-9);
    expect_box_around(object);
  }
}

TEST(Region_anchors, the_box_encloses_the_surface_at_rest_and_moved_and_scaled) {
  std::mt19937_64 random(6);
  for (const auto& [name, soup] : small_objects()) {
    SCOPED_TRACE(name);
    Anchored_object object(soup);
    object.move_to(soup);
    EXPECT_NEAR(object.tree().stretch(), 1, 1e-12);
    expect_box_around(object);
    for (const double factor : {0.25, 1.0, 3.0}) {
      object.move_to(placed(posed_at_random(soup, 5, random), factor));
      EXPECT_NEAR(object.tree().stretch(), std::max(1.0, factor), 1e-12);
      expect_box_around(object);
    }
  }
}

TEST(Region_anchors, the_box_of_a_small_surface_is_that_of_its_vertices) {
  std::mt19937_64 random(7);
  for (const auto& [name, soup] : small_objects()) {
    if (soup.vertex_count() > 256) continue;
    SCOPED_TRACE(name);
    Anchored_object object(soup);
    for (int pose = 0; pose < 3; ++pose) {
      object.find(posed_at_random(soup, 5, random), 2);
      Box expected;
      for (const auto& face : object.now().faces)
        for (const auto v : face)
          expected.extend(Eigen::Vector3d::Map(object.now().coordinates.data() + 3 * std::size_t{v}));
      EXPECT_EQ(object.regions().box().min(), expected.min());
      EXPECT_EQ(object.regions().box().max(), expected.max());
      object.find_regions();
      EXPECT_EQ(object.regions().box().min(), expected.min());
      EXPECT_EQ(object.regions().box().max(), expected.max());
    }
  }
}

TEST(Region_anchors, regions_that_are_found_are_those_that_are_read) {
  std::mt19937_64 random(8);
  const auto objects = small_objects();
  std::size_t listed = 0, small = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    SCOPED_TRACE(objects[i].first);
    Anchored_object a(objects[i].second), b(objects[(i + 2) % objects.size()].second);
    const auto a_now = posed_at_random(a.rest(), 0.8, random), b_now = posed_at_random(b.rest(), 0.8, random);
    a.move_to(a_now), b.move_to(b_now);
    const auto read = listed_pairs(a, b);
    a.find(a_now), b.find(b_now);
    a.find_regions(), b.find_regions();
    const auto found = listed_pairs(a, b);
    EXPECT_TRUE(std::ranges::includes(read, found));
    for (const auto& [face_a, face_b] : true_pairs(a.now(), b.now()))
      EXPECT_TRUE(found.contains({a.region_of(face_a), b.region_of(face_b)}));
    listed += found.size();
    small += a.rest().vertex_count() <= 256 ? 1 : 0;
  }
  EXPECT_GT(listed, 20U);
  EXPECT_GT(small, 0U);
}

TEST(Region_anchors, a_smaller_reach_lists_fewer_regions_and_no_others) {
  std::mt19937_64 random(7);
  Anchored_object a(icosphere(6)), b(torus_knot({.radius = 0.7, .segments = 40, .sides = 7}));
  std::size_t fewer = 0;
  for (int pose = 0; pose < 10; ++pose) {
    const auto a_now = posed_at_random(a.rest(), 0.8, random), b_now = posed_at_random(b.rest(), 0.8, random);
    a.move_to(a_now), b.move_to(b_now);
    const auto all = listed_pairs(a, b);
    a.move_to(a_now, 0.5), b.move_to(b_now, 0.5);
    const auto some = listed_pairs(a, b);
    EXPECT_TRUE(std::ranges::includes(all, some));
    fewer += all.size() - some.size();
  }
  EXPECT_GT(fewer, 10U);
}

TEST(Region_anchors, the_distance_of_near_regions_is_that_of_their_anchors) {
  Anchored_object a(icosphere(6)), b(icosphere(5));
  a.move_to(a.rest()), b.move_to(moved(b.rest(), 1.2, 0.3, 0.1));
  std::vector<Near_regions> near;
  list_near_regions(a.regions(), b.regions(), near);
  ASSERT_FALSE(near.empty());
  for (const auto& pair : near) {
    const std::uint32_t node_a = a.regions().node(pair.a), node_b = b.regions().node(pair.b);
    const double distance = (a.tree().anchor(node_a) - b.tree().anchor(node_b)).norm();
    EXPECT_NEAR(pair.distance, distance, 1e-12);
    EXPECT_NEAR(pair.order, std::pow(distance / (a.tree().radius(node_a) + b.tree().radius(node_b)), 2), 1e-6);
  }
}

TEST(Region_anchors, objects_far_apart_have_no_near_regions) {
  Anchored_object a(icosphere(4)), b(icosphere(4));
  a.move_to(a.rest()), b.move_to(moved(b.rest(), 9, 0, 0));
  EXPECT_TRUE(listed_pairs(a, b).empty());
  EXPECT_TRUE(a.regions().box().intersection(b.regions().box()).isEmpty());
}

/// The message of refusing regions at these nodes of an object of octants; empty: they are taken.
std::string refusal_of(Anchored_object& object, const std::vector<std::uint32_t>& nodes,
                       const std::vector<Region_index>& regions) {
  State_writer writer;
  writer.list(nodes), writer.list(regions);
  writer.list(std::vector<std::uint32_t>{0}), writer.list(std::vector<double>{1});
  writer.value(1.0);
  const auto bytes = writer.take();
  State_reader reader(bytes);
  try {
    Region_anchors::load(reader, object.tree().layout(), 8);
    return "";
  } catch (const Bad_saved_object& error) {
    return error.what();
  }
}

TEST(Region_anchors, that_are_loaded_share_no_faces) {
  Anchored_object object(icosphere(4));
  std::vector<std::uint32_t> nodes;
  std::vector<Region_index> regions;
  for (std::uint32_t place = 0; place < object.regions().size(); ++place) {
    nodes.push_back(object.regions().node(place));
    regions.push_back(object.regions().region(place));
  }
  ASSERT_EQ(nodes.size(), 8U);
  EXPECT_EQ(refusal_of(object, nodes, regions), "");
  const std::string shared = "the saved object is broken: two of its regions share faces";
  auto wrong = nodes;
  wrong[0] = 0;  // the root
  EXPECT_EQ(refusal_of(object, wrong, regions), shared);
  wrong = nodes, wrong[3] = wrong[2];
  EXPECT_EQ(refusal_of(object, wrong, regions), shared);
  auto twice = regions;
  twice[5] = twice[1];
  EXPECT_EQ(refusal_of(object, nodes, twice), shared);
}

/// All distances together grow by the square root of (4 * 4 + 1 + 1) / 3, or 2.4: too little along the axis.
TEST(Region_anchors, a_pull_in_one_direction_stretches_the_surface_nearly_as_much) {
  for (const std::size_t axis : {0, 1, 2}) {
    Anchored_object object(icosphere(6));
    object.move_to(pulled(object.rest(), axis, 4));
    EXPECT_GT(object.tree().stretch(), 0.8 * 4) << axis;
    EXPECT_LE(object.tree().stretch(), 4 * (1 + 1e-12)) << axis;
    expect_box_around(object);
  }
}

TEST(Region_anchors, a_surface_that_was_stretched_in_the_last_frame_is_not_in_this_one) {
  Anchored_object object(icosphere(6));
  object.move_to(placed(object.rest(), 3));
  EXPECT_NEAR(object.tree().stretch(), 3, 1e-12);
  const Box before = object.regions().box();
  object.move_to(object.rest());
  EXPECT_NEAR(object.tree().stretch(), 1, 1e-12);
  EXPECT_LT(object.regions().box().sizes().maxCoeff(), 0.5 * before.sizes().maxCoeff());
}

/// The labels of a fan of faces: its rim in so many sectors. Its tip has the last label, so each face has its sector's.
std::vector<Region_index> sectors(const Face_soup& fan, std::uint32_t count) {
  const std::uint32_t rim = fan.vertex_count() - 1;
  std::vector<Region_index> labels{count - 1};
  for (std::uint32_t i = 0; i < rim; ++i) labels.push_back(count * i / rim);
  return labels;
}

TEST(Region_anchors, that_are_one_vertex_notice_that_the_surface_grows) {
  const auto check = [](const Face_soup& soup, const std::vector<Region_index>& labels) {
    SCOPED_TRACE(soup.faces.size());
    Anchored_object object(soup, labels);
    for (const double factor : {1.0, 1.1, 3.0})
      for (const double offset : {0.0, 1e6}) {
        object.move_to(placed(soup, factor, offset));
        EXPECT_NEAR(object.tree().stretch(), factor, 1e-8);
        expect_box_around(object);
      }
  };
  std::vector<Region_index> labels{0, 1, 2, 3};
  do check(Face_soup(tetrahedron()), labels);
  while (std::next_permutation(labels.begin(), labels.end()));
  for (const std::uint32_t faces : {5U, 12U, 40U}) {
    const auto fan = fan_of_faces(faces, {0.1, 0.2, 0.3}, 0.5);
    for (const std::uint32_t count : {2U, 3U}) check(fan, sectors(fan, count));
  }
}

}  // namespace
}  // namespace lodestone
