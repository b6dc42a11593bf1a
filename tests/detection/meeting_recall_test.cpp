// SPDX-License-Identifier: GPL-3.0-or-later
// What mode `particles` finds by meetings in scenes that move and deform, against exhaustive checking.
#include <CGAL/boost/graph/Euler_operations.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "detection/detector_scenes.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

/// Two objects, and where the vertices are in each frame, as a function of where they were at rest.
struct Deforming_scene {
  std::string name;
  Owned_meshes rest;
  std::function<Point(std::size_t object, const Point& p, double time)> deformation;
};

Point wobbled(const Point& p, double time) {
  return {p.x() + 0.08 * std::sin(4 * p.y() + time), p.y() + 0.08 * std::sin(5 * p.z() + 1.3 * time),
          p.z() + 0.08 * std::sin(6 * p.x() + 0.7 * time)};
}

Surface_mesh small_knot() { return torus_knot({.radius = 0.7, .tube = 0.12, .segments = 60, .sides = 8}); }

/// The second object comes from x = 2.3, sinks into the first, and leaves again.
double approach(double time) { return 2.3 - 0.9 * (1 - std::cos(time)); }

std::vector<Deforming_scene> deforming_scenes() {
  const auto moving = [](std::size_t object, const Point& p, double time) {
    return object == 0 ? p : Point(p.x() + approach(time), p.y() + 0.2 * std::sin(time), p.z() + 0.1);
  };
  const auto spinning = [moving](std::size_t object, const Point& p, double time) {
    const double c = std::cos(2 * time), s = std::sin(2 * time);
    return moving(object, Point(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()), time);
  };
  const auto wobbling = [moving](std::size_t object, const Point& p, double time) {
    const Point q = moving(object, p, time / 2);
    return object == 0 ? wobbled(p, 2 * time) : wobbled(q, -time);
  };
  const auto inflating = [](std::size_t object, const Point& p, double time) {
    const double size = object == 0 ? 1 + 0.25 * time : 1;
    return Point(size * p.x() + (object == 0 ? 0 : 2.5), size * p.y() + 0.1, size * p.z());
  };
  const Owned_meshes spheres{sphere(10), sphere(12)}, potatoes{potato(11), potato(10, 2)};
  const Owned_meshes knots{small_knot(), small_knot()}, mixed{sphere(10), small_knot()};
  return {{"spheres moving", spheres, moving},       {"spheres inflating", spheres, inflating},
          {"potatoes spinning", potatoes, spinning}, {"potatoes wobbling", potatoes, wobbling},
          {"knots spinning", knots, spinning},       {"knots wobbling", knots, wobbling},
          {"sphere and knot moving", mixed, moving}, {"sphere and knot inflating", mixed, inflating}};
}

void pose_scene(const Deforming_scene& scene, double time, Owned_meshes& meshes) {
  for (std::size_t object = 0; object < meshes.size(); ++object)
    for (const auto v : meshes[object].vertices())
      meshes[object].point(v) = scene.deformation(object, scene.rest[object].point(v), time);
}

/// What was found in all frames of a scene.
struct Scene_recall {
  std::size_t colliding = 0, found = 0, apart = 0;  ///< frames
  std::size_t contacts = 0, reported = 0;           ///< face pairs
  std::size_t repartitions = 0;
};

/// Plays a scene; everything that is found must be true.
Scene_recall play(const Deforming_scene& scene, const Detector_options& options) {
  SCOPED_TRACE(scene.name);
  constexpr int frames = 48;
  Owned_meshes meshes = scene.rest;
  pose_scene(scene, 0, meshes);
  Detector<> detector(options);
  add_all(detector, meshes);
  Scene_recall recall;
  for (int number = 0; number < frames; ++number) {
    pose_scene(scene, 2 * EIGEN_PI * number / frames, meshes);
    detector.update();
    const Frame& frame = detector.detect();
    const auto truth = exhaustive_face_pairs(meshes[0], meshes[1]);
    EXPECT_TRUE(std::ranges::includes(truth, frame.face_pairs)) << number;
    EXPECT_TRUE(!frame.collides() || !truth.empty()) << number;
    (truth.empty() ? recall.apart : recall.colliding) += 1;
    recall.found += frame.collides() ? 1 : 0;
    recall.contacts += truth.size();
    recall.reported += frame.face_pairs.size();
    recall.repartitions += frame.statistics.repartitions;
  }
  EXPECT_GT(recall.colliding, 5U);
  return recall;
}

Detector_options meeting_options(Contact_query query) {
  return {.mode = Mode::particles, .particles = 16, .contacts = query};
}

TEST(Meeting_recall, every_collision_of_deforming_objects_is_found) {
  for (const auto& scene : deforming_scenes())
    for (const auto query : {Contact_query::yes_no, Contact_query::first}) {
      const auto recall = play(scene, meeting_options(query));
      EXPECT_EQ(recall.found, recall.colliding) << scene.name;
      EXPECT_EQ(recall.reported, query == Contact_query::first ? recall.found : 0) << scene.name;
    }
}

TEST(Meeting_recall, with_all_contacts_the_face_pairs_are_those_of_exhaustive_checking) {
  for (const auto& scene : deforming_scenes()) {
    const auto recall = play(scene, meeting_options(Contact_query::all));
    EXPECT_EQ(recall.found, recall.colliding) << scene.name;
    EXPECT_EQ(recall.reported, recall.contacts) << scene.name;
    if (scene.name.ends_with("inflating")) {
      EXPECT_GT(recall.repartitions, 0U) << scene.name;
    } else if (!scene.name.ends_with("wobbling")) {
      EXPECT_EQ(recall.repartitions, 0U) << scene.name;
    }
  }
}

TEST(Meeting_recall, objects_that_are_never_repartitioned_are_found_when_they_inflate) {
  for (const auto& scene : deforming_scenes()) {
    if (!scene.name.ends_with("inflating")) continue;
    auto options = meeting_options(Contact_query::all);
    options.growth = std::numeric_limits<double>::infinity();
    const auto recall = play(scene, options);
    EXPECT_EQ(recall.repartitions, 0U);
    EXPECT_EQ(recall.reported, recall.contacts) << scene.name;
  }
}

TEST(Meeting_recall, a_tiny_budget_leaves_most_collisions_to_walks_and_gives_no_false_answer) {
  for (const std::size_t budget : {0, 1, 10})
    for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
      auto options = meeting_options(query);
      options.opening_budget = budget;
      std::size_t found = 0, colliding = 0;
      for (const auto& scene : deforming_scenes()) {
        const auto recall = play(scene, options);
        found += recall.found, colliding += recall.colliding;
      }
      EXPECT_GT(2 * found, colliding) << budget;
    }
}

TEST(Meeting_recall, pairs_whose_particles_walk_do_not_get_the_contacts_of_pairs_that_are_known) {
  // One of each two spheres changes sides in every fourth frame. So some pairs are found where they were, beside others
  // whose particles walk.
  for (const auto query : {Contact_query::first, Contact_query::all})
    for (const std::size_t budget : {0, 60, 200}) {
      Owned_meshes scene;
      for (int i = 0; i < 6; ++i) scene.push_back(sphere(10, 1, {10.0 * (i / 2) + 1.7 * (i % 2), 0, 0.1 * (i % 2)}));
      auto options = meeting_options(query);
      options.opening_budget = budget;
      Detector<> detector(options);
      add_all(detector, scene);
      std::size_t found = 0;
      for (int frame = 0; frame < 12; ++frame) {
        for (std::size_t pair = 0; pair < 3; ++pair)
          if (frame % 4 == static_cast<int>(pair)) shift(scene[2 * pair], frame % 8 < 4 ? 3.4 : -3.4);
        found += expect_true(detector.detect(), scene);
      }
      EXPECT_GT(found, 18U) << budget;
    }
}

TEST(Meeting_recall, a_shorter_reach_gives_no_false_answer) {
  for (const auto query : {Contact_query::first, Contact_query::all}) {
    auto options = meeting_options(query);
    options.opening_reach = 0.5;
    std::size_t found = 0, colliding = 0;
    for (const auto& scene : deforming_scenes()) {
      const auto recall = play(scene, options);
      found += recall.found, colliding += recall.colliding;
    }
    EXPECT_GT(found, 0U);
    EXPECT_LT(found, colliding) << "the reach has no effect";
  }
}

TEST(Meeting_recall, triangles_that_share_no_vertices_are_found_across_their_seams) {
  for (const std::size_t budget : {std::size_t{10}, Detector_options{}.opening_budget}) {
    Deforming_scene scene = deforming_scenes()[2];
    for (auto& mesh : scene.rest) mesh = flat_shaded(mesh);
    auto options = meeting_options(Contact_query::all);
    options.opening_budget = budget;
    const auto recall = play(scene, options);
    EXPECT_GT(2 * recall.found, recall.colliding);
    if (budget > 10) {
      EXPECT_EQ(recall.reported, recall.contacts);
    }
  }
}

/// Collapses edges until about half of the faces are left, and numbers the rest anew.
void halve_faces(Surface_mesh& mesh) {
  std::mt19937_64 random(2);
  for (const auto wanted = mesh.number_of_faces() / 2; mesh.number_of_faces() > wanted;) {
    const Surface_mesh::Edge_index e(static_cast<std::uint32_t>(random() % mesh.num_edges()));
    if (!mesh.is_removed(e) && CGAL::Euler::does_satisfy_link_condition(e, mesh)) CGAL::Euler::collapse_edge(e, mesh);
  }
  mesh.collect_garbage();
}

TEST(Meeting_recall, nothing_of_the_old_faces_is_remembered_after_a_rebuild) {
  for (const auto query : {Contact_query::yes_no, Contact_query::first, Contact_query::all})
    for (const Object_id changed : {0U, 1U}) {
      auto scene = two_spheres(1.9);
      Detector<> detector(meeting_options(query));
      add_all(detector, scene);
      for (int frame = 0; frame < 3; ++frame) EXPECT_TRUE(detector.detect().collides());
      halve_faces(scene[changed]);
      detector.rebuild(changed);
      for (int number = 0; number < 3; ++number) {
        const Frame& frame = detector.detect();
        const auto truth = exhaustive_face_pairs(scene[0], scene[1]);
        EXPECT_EQ(frame.collides(), !truth.empty());
        EXPECT_TRUE(std::ranges::includes(truth, frame.face_pairs));
        if (query == Contact_query::all) {
          EXPECT_EQ(frame.face_pairs, truth);
        }
        shift(scene[1], -0.1);
        detector.update();
      }
    }
}

TEST(Meeting_recall, objects_that_are_placed_are_found_where_they_are) {
  const auto shape = potato(10, 2);
  auto still = potato(10), placed_mesh = shape, written = shape;
  Detector<> detector(meeting_options(Contact_query::all));
  detector.add(still), detector.add(placed_mesh);
  std::size_t contacts = 0;
  for (int number = 0; number < 20; ++number) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.rotate(Eigen::AngleAxisd(0.2 * number, Eigen::Vector3d(1, -2, 3).normalized()));
    motion.pretranslate(Eigen::Vector3d(2.2 - 0.1 * number, 0.1, 0.02 * number));
    detector.place(1, motion);
    const Rigid_motion placement(motion);
    for (const auto v : shape.vertices()) {
      const Eigen::Vector3d q = placement(coordinates(shape.point(v)));
      written.point(v) = Point(q.x(), q.y(), q.z());
    }
    const auto truth = exhaustive_face_pairs(still, written);
    EXPECT_EQ(detector.detect().face_pairs, truth);
    contacts += truth.size();
  }
  EXPECT_GT(contacts, 100U);
}

TEST(Meeting_recall, a_single_face_is_found_however_far_it_is_stretched) {
  const auto one_face = [](const Triangle& t) {
    Surface_mesh mesh;
    mesh.add_face(mesh.add_vertex(t[0]), mesh.add_vertex(t[1]), mesh.add_vertex(t[2]));
    return mesh;
  };
  auto needle = one_face({Point(-0.5, 0, 0), Point(0.5, 0, 0), Point(0, 0.05, 0)});
  auto plate = one_face({Point(1, -0.1, -0.1), Point(1, 0.1, -0.1), Point(1, 0, 0.1)});
  Detector<> detector({.mode = Mode::particles});
  detector.add(needle);
  detector.add(plate);
  std::size_t colliding = 0;
  for (const double half : {0.5, 0.7, 0.9, 1.05, 1.5, 4.0}) {
    needle.point(Surface_mesh::Vertex_index(0)) = Point(-half, 0, 0);
    needle.point(Surface_mesh::Vertex_index(1)) = Point(half, 0, 0);
    const auto truth = exhaustive_face_pairs(needle, plate);
    EXPECT_EQ(detector.detect().face_pairs, truth) << half;
    colliding += truth.empty() ? 0 : 1;
  }
  EXPECT_GE(colliding, 2U);
}

/// A sphere with a bump of a width and height, in radii, around a direction.
void grow_bump(const Surface_mesh& rest, const Eigen::Vector3d& direction, double width, double height,
               Surface_mesh& mesh) {
  for (const auto v : rest.vertices()) {
    const Eigen::Vector3d p = coordinates(rest.point(v));
    const double angle = std::acos(std::clamp(p.dot(direction), -1.0, 1.0)) / width;
    const Eigen::Vector3d q = (1 + height * std::exp(-angle * angle / 2)) * p;
    mesh.point(v) = Point(q.x(), q.y(), q.z());
  }
}

TEST(Meeting_recall, a_bump_that_grows_out_of_a_sphere_is_found_wherever_it_grows) {
  constexpr int frames = 12;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::size_t colliding = 0;
  for (const double width : {0.1, 0.2, 0.3})
    for (const double height : {0.3, 0.6})
      for (int place = 0; place < 5; ++place) {
        const Eigen::Vector3d direction = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        const auto rest = sphere(10);
        const Eigen::Vector3d centre = (1.5 + 0.6 * height) * direction;  // the bump ends inside
        auto bumped = rest, other = sphere(8, 0.5, Point(centre.x(), centre.y(), centre.z()));
        Detector<> detector({.mode = Mode::particles, .contacts = Contact_query::yes_no});
        detector.add(bumped);
        detector.add(other);
        for (int number = 0; number <= frames; ++number) {
          grow_bump(rest, direction, width, height * number / frames, bumped);
          detector.update();
          const bool collide = !exhaustive_face_pairs(bumped, other).empty();
          EXPECT_EQ(detector.detect().collides(), collide) << width << ' ' << height << ' ' << number;
          colliding += collide ? 1 : 0;
        }
      }
  EXPECT_GT(colliding, 100U);
}

TEST(Meeting_recall, a_spike_of_one_vertex_is_found_with_a_larger_reach) {
  constexpr int frames = 8;
  std::size_t colliding = 0, missed_by_default = 0;
  for (const double height : {0.5, 1.0, 2.0})
    for (std::uint32_t vertex = 0; vertex < 400; vertex += 57) {
      const auto rest = sphere(10);
      const Surface_mesh::Vertex_index tip(vertex);
      const Eigen::Vector3d direction = coordinates(rest.point(tip)).normalized();
      const Eigen::Vector3d centre = (1.3 + 0.8 * height) * direction;  // the spike ends inside
      auto spiked = rest, other = sphere(8, 0.3, Point(centre.x(), centre.y(), centre.z()));
      Detector<> far({.mode = Mode::particles, .opening_reach = 4, .contacts = Contact_query::yes_no});
      Detector<> usual({.mode = Mode::particles, .contacts = Contact_query::yes_no});
      for (auto* const detector : {&far, &usual}) {
        detector->add(std::as_const(spiked));
        detector->add(std::as_const(other));
      }
      for (int number = 0; number <= frames; ++number) {
        const Eigen::Vector3d at = (1 + height * number / frames) * direction;
        spiked.point(tip) = Point(at.x(), at.y(), at.z());
        const bool collide = !exhaustive_face_pairs(spiked, other).empty();
        far.update();
        usual.update();
        EXPECT_EQ(far.detect().collides(), collide) << height << ' ' << vertex << ' ' << number;
        const bool found = usual.detect().collides();
        missed_by_default += collide && !found ? 1 : 0;
        colliding += collide ? 1 : 0;
      }
    }
  EXPECT_GT(colliding, 40U);
  EXPECT_GT(missed_by_default, 0U) << "otherwise docs/modes.md warns of nothing";
}

TEST(Meeting_recall, pairs_that_part_and_meet_again_elsewhere_are_found_among_many_objects) {
  for (const auto query : {Contact_query::yes_no, Contact_query::all}) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> place(-2.2, 2.2), step(-0.3, 0.3), size(0.4, 0.9);
    Owned_meshes scene;
    for (int i = 0; i < 14; ++i)
      scene.push_back(sphere(6, size(random), {place(random), place(random), place(random)}));
    Detector<> detector(meeting_options(query));
    add_all(detector, scene);
    std::size_t colliding = 0;
    for (int number = 0; number < 25; ++number) {
      if (number == 12) detector.remove(3);
      const Frame& frame = detector.detect();
      for (Object_id a = 0; a < scene.size(); ++a)
        for (Object_id b = a + 1; b < scene.size(); ++b) {
          if (number >= 12 && (a == 3 || b == 3)) {
            EXPECT_EQ(result_of(frame, a, b), nullptr);
            continue;
          }
          const auto truth = exhaustive_face_pairs(scene[a], scene[b]);
          const Pair_result* result = result_of(frame, a, b);
          EXPECT_EQ(result != nullptr && result->collides, !truth.empty()) << number << ": " << a << ", " << b;
          if (query == Contact_query::all) {
            EXPECT_EQ(contacts_of(frame, a, b), truth);
          }
          colliding += truth.empty() ? 0 : 1;
        }
      for (auto& mesh : scene) shift(mesh, step(random), step(random), step(random));
      detector.update();
    }
    EXPECT_GT(colliding, 100U);
  }
}

}  // namespace
}  // namespace lodestone
