// SPDX-License-Identifier: GPL-3.0-or-later
// Mode certified gives the answers of mode exact, and reads little where little is near.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include "detection/certified_scene.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

TEST(Certified, gives_the_answers_of_mode_exact) {
  std::size_t colliding = 0, apart = 0;
  for (const Detector_options& options : questions()) {
    Certified_scene scene;
    Detector certified(in_mode(Mode::certified, options)), exact(in_mode(Mode::exact, options));
    scene.add_to(certified);
    scene.add_to(exact);
    for (int frame = 0; frame < 12; ++frame) {
      SCOPED_TRACE(frame);
      scene.pose(frame);
      const Frame& found = certified.detect();
      expect_same_answers(found, exact.detect(), 4);
      EXPECT_EQ(found.statistics.violations, 0U);
      for (Object_id a = 0; a < 4; ++a)
        for (Object_id b = a + 1; b < 4; ++b) ++(result_or_none(found, a, b).collides ? colliding : apart);
    }
  }
  EXPECT_GT(colliding, 50U);
  EXPECT_GT(apart, 50U);
}

/// The two limbs of a scene, asked for yes or no in the modes `certified` and `exact`.
struct Two_limbs {
  explicit Two_limbs(double tolerance)
      : certified(in_mode(Mode::certified, question(tolerance))), exact(in_mode(Mode::exact, question(tolerance))) {
    scene.add_to(certified);
    scene.add_to(exact);
    pose(9, 0);
    boxes();  // the first frame reads all
  }
  static Detector_options question(double tolerance) {
    return {.contacts = Contact_query::yes_no, .exact = {.tolerance = tolerance}};
  }
  void pose(double apart, int frame) {
    bend(scene.upper_points, 0.1 + 0.001 * frame, {0, 0, apart});
    bend(scene.lower_points, 0.1, {0, 0, 0});
  }
  /// How many boxes a frame asks the bounds for. The answers of the modes must be the same.
  std::size_t boxes() {
    const Frame& found = certified.detect(0, 1);
    const Frame& truth = exact.detect(0, 1);
    EXPECT_EQ(found.collides(), truth.collides());
    EXPECT_EQ(found.near(), truth.near());
    collides = truth.collides(), near = truth.near();
    return found.statistics.nodes_bounded;
  }

  Certified_scene scene;
  Detector<> certified, exact;
  bool collides = false, near = false;  ///< in the last frame
};

TEST(Certified, a_contact_that_lasts_is_found_where_it_was) {
  constexpr std::size_t roots = 2, roots_and_two_leaves = 4;
  Two_limbs limbs(0);
  limbs.pose(0.9, 0);
  const std::size_t at_first = limbs.boxes();
  EXPECT_TRUE(limbs.collides);
  EXPECT_GT(at_first, roots_and_two_leaves);
  for (int frame = 1; frame < 6; ++frame) {
    limbs.pose(0.9, frame);
    EXPECT_EQ(limbs.boxes(), roots_and_two_leaves);
    EXPECT_TRUE(limbs.collides);
  }
  limbs.pose(9, 6);
  EXPECT_EQ(limbs.boxes(), roots);
  limbs.pose(0.9, 0);
  EXPECT_EQ(limbs.boxes(), at_first);  // there was no contact to begin with
  limbs.certified.rebuild(0);          // the tree can have other leaves now
  limbs.pose(0.9, 1);
  limbs.boxes();
  EXPECT_TRUE(limbs.collides);
  limbs.certified.detect();  // of all pairs
  for (int frame = 2; frame < 4; ++frame) {
    limbs.pose(0.9, frame);
    EXPECT_EQ(limbs.boxes(), roots_and_two_leaves);
  }
  limbs.certified.ignore(0, 1);
  limbs.certified.detect();  // forgets the pair
  limbs.certified.ignore(0, 1, false);
  limbs.pose(0.9, 0);
  EXPECT_EQ(limbs.boxes(), at_first);
}

TEST(Certified, nearness_that_lasts_is_found_where_it_was) {
  Two_limbs limbs(0.1);
  double apart = 0.9;
  std::size_t at_first = 0;
  do {
    apart += 0.01;
    limbs.pose(9, 0);
    limbs.boxes();  // so that there is nothing to begin with
    limbs.pose(apart, 0);
    at_first = limbs.boxes();
  } while (limbs.collides);
  ASSERT_TRUE(limbs.near);
  limbs.pose(apart, 0);
  EXPECT_LT(limbs.boxes(), at_first);
  EXPECT_TRUE(limbs.near && !limbs.collides);
}

TEST(Certified, a_first_contact_is_a_contact) {
  Certified_scene scene;
  Detector certified(in_mode(Mode::certified, {.contacts = Contact_query::first})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  for (int frame = 0; frame < 12; ++frame) {
    scene.pose(frame);
    const Frame& found = certified.detect();
    const Frame& truth = exact.detect();
    for (const auto& pair : truth.pairs) {
      const auto one = contacts_of(found, pair.a, pair.b);
      EXPECT_EQ(one.size(), pair.collides ? 1U : 0U);
      for (const auto& contact : one) EXPECT_TRUE(std::ranges::count(truth.contacts(pair), contact));
    }
  }
}

TEST(Certified, a_capped_list_holds_contacts) {
  Certified_scene scene;
  Detector certified(in_mode(Mode::certified, {.most_contacts = 3})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  scene.pose(3);
  const Frame& found = certified.detect();
  const Frame& truth = exact.detect();
  EXPECT_TRUE(found.capped());
  for (const auto& pair : truth.pairs) {
    const auto some = contacts_of(found, pair.a, pair.b);
    EXPECT_EQ(some.size(), std::min<std::size_t>(3, pair.contacts));
    for (const auto& contact : some) EXPECT_TRUE(std::ranges::count(truth.contacts(pair), contact));
  }
}

TEST(Certified, single_questions_have_the_answers_of_mode_exact) {
  Certified_scene scene;
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  scene.add_to(certified);
  scene.add_to(exact);
  bool stopped = false;
  for (int frame = 0; frame < 10; ++frame) {
    SCOPED_TRACE(frame);
    scene.pose(frame);
    for (Object_id a = 0; a < 4; ++a)
      for (Object_id b = 0; b < 4; ++b) {
        if (a == b) continue;
        const auto nearest = certified.closest(a, b), true_nearest = exact.closest(a, b);
        EXPECT_EQ(nearest.faces, true_nearest.faces);
        EXPECT_EQ(nearest.points.distance, true_nearest.points.distance);
        EXPECT_EQ(certified.contains(a, b), exact.contains(a, b));
        std::set<Face_pair> shown, truly;
        const auto shows = [](std::set<Face_pair>& set) {
          return [&set](Face_pair pair) {
            EXPECT_TRUE(set.insert(pair).second);
            return Visit::go_on;
          };
        };
        certified.visit(a, b, shows(shown));
        exact.visit(a, b, shows(truly));
        EXPECT_EQ(shown, truly);
        int calls = 0;
        const auto end = certified.visit(a, b, [&](Face_pair) { return ++calls, Visit::stop; });
        EXPECT_EQ(calls, truly.empty() ? 0 : 1);
        EXPECT_EQ(end == Visit::stop, !truly.empty());
        stopped |= end == Visit::stop;
        expect_same_answers(certified.detect(a, b), exact.detect(a, b), 4);
        EXPECT_EQ(certified.parting(a, b).has_value(), exact.parting(a, b).has_value());
      }
  }
  EXPECT_TRUE(stopped);
}

TEST(Certified, placed_given_and_rebuilt_objects_have_the_answers_of_mode_exact) {
  Certified_scene scene;
  Detector certified(in_mode(Mode::certified, {.exact = {.self_collision = true}})),
      exact(in_mode(Mode::exact, {.exact = {.self_collision = true}}));
  scene.add_to(certified);
  scene.add_to(exact);
  Positions given(static_cast<Eigen::Index>(scene.lower.number_of_vertices()), 3);
  for (const auto v : scene.lower.vertices())
    given.row(static_cast<Eigen::Index>(v.idx())) << scene.lower.point(v).x(), 1.1, scene.lower.point(v).z();
  for (int frame = 0; frame < 16; ++frame) {
    SCOPED_TRACE(frame);
    if (frame < 12) scene.pose(frame);  // afterwards only the detectors are told
    for (Detector<>* detector : {&certified, &exact}) {
      if (frame % 3 == 1)
        detector->place(0, Eigen::Isometry3d(Eigen::Translation3d(0.2, 0.1 * frame, 0) *
                                             Eigen::AngleAxisd(0.3 * frame, Eigen::Vector3d(0.6, 0.8, 0))));
      if (frame == 8) detector->place(0, Eigen::Isometry3d::Identity());
      if (frame % 4 == 2) detector->update(1, given);
      if (frame % 4 == 3) detector->update(1);
      if (frame == 6) detector->rebuild(0);
      if (frame == 14) detector->remove(2);
    }
    expect_same_answers(certified.detect(), exact.detect(), 4);
  }
}

TEST(Certified, saved_objects_have_the_answers_of_mode_exact) {
  Certified_scene scene;
  Detector saving(in_mode(Mode::certified, {})), certified(in_mode(Mode::certified, {})),
      exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&saving, &certified, &exact}) scene.add_to(*detector);
  scene.pose(0);
  saving.detect();
  scene.pose(1);  // what is saved is not of the last frame
  for (Object_id object = 0; object < 4; ++object) certified.load(object, saving.save(object));
  for (int frame = 2; frame < 8; ++frame) {
    scene.pose(frame);
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 4);
    EXPECT_EQ(found.statistics.builds, 0U);
    EXPECT_EQ(found.statistics.nodes_bounded > 0, frame > 2);  // the first frame reads everything
  }
}

TEST(Certified, polyhedra_whose_vertices_have_no_ids_are_bounded_too) {
  Certified_scene scene;
  CGAL::Polyhedron_3<Kernel> upper, lower;
  CGAL::copy_face_graph(scene.upper, upper);
  CGAL::copy_face_graph(scene.lower, lower);
  const auto points_of = [](const auto& polyhedron) {
    Surface_mesh mesh;  // its vertices are in the order of the polyhedron
    CGAL::copy_face_graph(polyhedron, mesh);
    return limb(mesh);
  };
  auto upper_points = points_of(upper), lower_points = points_of(lower);
  Detector certified(in_mode(Mode::certified, {})), exact(in_mode(Mode::exact, {}));
  for (Detector<>* detector : {&certified, &exact}) {
    detector->add(upper, point_map(upper, upper_points));
    detector->add(lower, point_map(lower, lower_points));
  }
  std::size_t colliding = 0, bounded = 0;
  for (int frame = 0; frame < 8; ++frame) {
    bend(upper_points, 0.3 * frame, {0, 0, 1.5 * std::cos(0.5 * frame)});
    bend(lower_points, -0.4 * frame, {0, 0, 0});
    const Frame& found = certified.detect();
    expect_same_answers(found, exact.detect(), 2);
    colliding += found.collides() ? 1 : 0;
    bounded += found.statistics.nodes_bounded;
  }
  EXPECT_GT(colliding, 1U);
  EXPECT_GT(bounded, 10U);
}

TEST(Certified, reads_little_where_little_is_near) {
  Surface_mesh a = long_body(40, 1), b = long_body(40, 1);
  Skinned_points a_points = limb(a), b_points = limb(b);
  Detector detector({.mode = Mode::certified});
  detector.add(a, point_map(a, a_points));
  detector.add(b, point_map(b, b_points));
  detector.detect();
  bend(a_points, 0.1, {0, 0, 0});
  bend(b_points, 0.1, {0, 0, 20});
  const Frame& apart = detector.detect();
  EXPECT_EQ(apart.statistics.vertices_read, 0U);
  EXPECT_EQ(apart.statistics.nodes_bounded, 2U);
  double x = 12;
  for (bool met = false; !met; x -= 0.02) {
    bend(b_points, 0.1, {x, 0, 0});
    met = detector.detect().collides();
    ASSERT_GT(x, 3);
  }
  const Frame& again = detector.detect();  // nothing has moved: nothing is read
  EXPECT_TRUE(again.collides());
  EXPECT_EQ(again.statistics.vertices_read, 0U);
  bend(b_points, 0.1, {x + 0.019, 0, 0});
  const Frame_statistics touching = detector.detect().statistics;
  EXPECT_GT(touching.leaves_posed, 0U);
  EXPECT_LT(touching.vertices_read, a.number_of_vertices() / 4);
  std::array<std::size_t, 3> leaves{};
  const Bounded_surface& of_b = *detector.bounded(1);
  for (std::uint32_t leaf = 0; leaf < of_b.layout().leaf_count(); ++leaf)
    ++leaves[static_cast<std::size_t>(of_b.leaf_state(leaf))];
  EXPECT_GT(leaves[static_cast<std::size_t>(Bounded_surface::Leaf_state::far)], of_b.layout().leaf_count() / 2);
  EXPECT_EQ(leaves[static_cast<std::size_t>(Bounded_surface::Leaf_state::posed)], of_b.leaves_posed());
}

TEST(Certified, names_the_object_of_a_vertex_that_is_not_finite) {
  Certified_scene scene;
  Detector detector(in_mode(Mode::certified, {}));
  scene.add_to(detector);
  scene.pose(0);
  detector.detect();
  auto motions = std::vector<Eigen::Affine3d>(2, Eigen::Affine3d(Eigen::Scaling(1.7e308)));
  motions[1] = Eigen::Translation3d(1.7e308, 0, 0) * motions[1];
  scene.upper_points.set_joints(motions);
  for (int twice = 0; twice < 2; ++twice) {
    const auto message = message_of<Bad_mesh>([&] { detector.detect(); });
    EXPECT_NE(message.find("of object 0 (upper)"), std::string::npos) << message;
  }
  scene.pose(1);
  EXPECT_NO_THROW(detector.detect());
}

TEST(Certified, is_no_mode_of_other_volumes_and_takes_no_options_of_particles) {
  EXPECT_THROW((Volume_detector<Bounding_sphere>({.mode = Mode::certified})), Bad_argument);
  EXPECT_THROW(Detector({.mode = Mode::certified, .growth = 2}), Bad_argument);
  Certified_scene scene;
  Detector exact;
  scene.add_to(exact);
  exact.detect();
  EXPECT_EQ(exact.bounded(0), nullptr);
}

}  // namespace
}  // namespace lodestone
