// SPDX-License-Identifier: GPL-3.0-or-later
// The C++ of README and pages, word for word: docs.snippets compares them. Here it is compiled and run.
#include <gtest/gtest.h>
#include <lodestone/bounds/displacement_bound.h>
#include <lodestone/bounds/lipschitz_bound.h>
#include <lodestone/bounds/motion_bound.h>
#include <lodestone/detector.h>
#include <lodestone/find_collisions.h>
#include <lodestone/find_first_impact.h>
#include <lodestone/io/meshes/mesh_file.h>
#include <lodestone/io/objects/object_file.h>
#include <lodestone/mesh/computed_points.h>
#include <lodestone/mesh/indexed_mesh.h>
#include <lodestone/mesh/skinned_points.h>
#include <lodestone/partition/lbg.h>
#include <lodestone/partition/partition_measures.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string_view>

#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace {

using lodestone::Surface_mesh;

std::size_t responses = 0, pushes = 0, moves = 0;

void respond(std::uint32_t /*face_a*/, std::uint32_t /*face_b*/) { ++responses; }
void push(const lodestone::Pair_result& pair, const lodestone::Face_pair& /*faces*/,
          const lodestone::Intersection_points& points, const lodestone::Contact_normal& /*normal*/) {
  EXPECT_TRUE(pair.collides || pair.near);
  EXPECT_FALSE(points.empty());
  ++pushes;
}
/// Moves the second towards the first, five times.
bool move(Surface_mesh& /*cloth*/, Surface_mesh& body) {
  lodestone::shift(body, -0.2);
  return ++moves % 6 != 0;
}

struct Lbg_with_curvature {
  static constexpr std::string_view name = "lbg_with_curvature";
  lodestone::Labelling operator()(const lodestone::Partition_input<lodestone::Surface_mesh>& input,
                                  std::size_t regions) const {
    const auto map = input.mesh.property_map<CGAL::SM_Vertex_index, double>("v:curvature").first;
    return lodestone::Lbg{.extra_factors = lodestone::factors(input.mesh, map, 0.2)}(input, regions);
  }
};

struct Slices {
  static constexpr std::string_view name = "slices";
  lodestone::Labelling operator()(const lodestone::Partition_input<lodestone::Surface_mesh>& input,
                                  std::size_t regions) const;
};
/// As many vertices in each region, from below upwards.
lodestone::Labelling Slices::operator()(const lodestone::Partition_input<lodestone::Surface_mesh>& input,
                                        std::size_t regions) const {
  const auto vertices = static_cast<std::size_t>(input.positions.rows());
  std::vector<std::uint32_t> order(vertices);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return input.positions(v, 2); });
  lodestone::Labelling labelling{.labels = std::vector<lodestone::Region_index>(vertices)};
  for (std::size_t i = 0; i < vertices; ++i)
    labelling.labels[order[i]] = static_cast<lodestone::Region_index>(i * regions / vertices);
  return labelling;
}

class Falling_bound {
 public:
  Falling_bound(const double& fallen, const lodestone::Bounded_object& object);
  std::size_t node_count() const { return rest_.size(); }
  lodestone::Aabb box(std::uint32_t node) const;

 private:
  const double* fallen_;
  std::vector<lodestone::Aabb> rest_;  // per node
};
Falling_bound::Falling_bound(const double& fallen, const lodestone::Bounded_object& object)
    : fallen_(&fallen), rest_(object.layout.node_count()) {
  const lodestone::Tree_layout& tree = object.layout;
  for (auto node = static_cast<std::uint32_t>(rest_.size()); node-- > 0;)
    if (tree.is_leaf(node))
      rest_[node].enclose(tree.leaf_faces(tree.node(node).leaf, object.rest));
    else
      rest_[node].enclose(rest_[node + 1], rest_[tree.node(node).second_child]);
}
lodestone::Aabb Falling_bound::box(std::uint32_t node) const {
  lodestone::Aabb box = rest_[node];
  box.low[2] -= *fallen_;
  box.high[2] -= *fallen_;
  lodestone::open_if_not_finite(box, 2);
  return box;
}
struct Falling_promise {
  double fallen = 0;  // since the first query
  Falling_bound bound(const lodestone::Bounded_object& object) const { return {fallen, object}; }
};

class Leaning_points {
 public:
  explicit Leaning_points(const lodestone::Surface_mesh& rest) : rest_(&rest) {}
  void set_lean(double lean) { lean_ = lean, ++pose_number_; }

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(num_vertices(*rest_)); }
  std::uint64_t pose_number() const { return pose_number_; }
  Eigen::Vector3d operator()(std::uint32_t vertex) const {
    const lodestone::Point& at = rest_->point(lodestone::Surface_mesh::Vertex_index(vertex));
    return {at.x() + lean_ * at.z(), at.y(), at.z()};
  }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const {
    for (const auto vertex : vertices) write(vertex, coordinates);
  }
  void pose_all(std::span<double> coordinates) const {
    for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex) write(vertex, coordinates);
  }

 private:
  void write(std::uint32_t vertex, std::span<double> coordinates) const {
    Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
  }
  const lodestone::Surface_mesh* rest_;
  double lean_ = 0;
  std::uint64_t pose_number_ = 1;
};

/// Is the working folder while it lives.
class Working_folder {
 public:
  explicit Working_folder(const std::filesystem::path& folder) { std::filesystem::current_path(folder); }
  ~Working_folder() { std::filesystem::current_path(before_); }
  Working_folder(const Working_folder&) = delete;

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

class Snippets : public testing::Test {
 protected:
  void SetUp() override { responses = pushes = moves = 0; }

  Surface_mesh cloth_mesh = lodestone::sphere(8), body_mesh = lodestone::sphere(6, 1, {2.6, 0.1, 0.2});
  Surface_mesh mesh = lodestone::sphere(12), mesh_a = lodestone::sphere(8),
               mesh_b = lodestone::sphere(6, 1, {1.5, 0, 0});
  const Surface_mesh &a = mesh_a, &b = mesh_b;
};

TEST_F(Snippets, of_the_readme) {
  const auto found = lodestone::find_collisions(mesh_a, mesh_b);  // misses nothing
  const auto by_particles =
      lodestone::find_collisions(mesh_a, mesh_b, {.mode = lodestone::Mode::particles, .particles = 32});
  const auto folds = lodestone::find_self_collisions(mesh_a);
  EXPECT_FALSE(folds.collides);
  EXPECT_TRUE(found.collides);
  EXPECT_TRUE(std::ranges::includes(found.faces, by_particles.faces));
}

TEST_F(Snippets, of_one_call) {
  const auto found = lodestone::find_collisions(a, b);
  for (const auto& [face_a, face_b] : found.faces) respond(face_a, face_b);
  EXPECT_EQ(responses, found.faces.size());
  EXPECT_GT(responses, 0U);
}

TEST_F(Snippets, of_one_call_with_points_beside_the_mesh) {
  const auto points = get(CGAL::vertex_point, a);
  const auto moved_points = get(CGAL::dynamic_vertex_property_t<lodestone::Point>(), a);
  for (const auto v : a.vertices())
    put(moved_points, v, lodestone::Point(a.point(v).x() + 0.5, a.point(v).y(), a.point(v).z() + 0.25));
  const auto moved = lodestone::find_collisions(a, a, {}, CGAL::parameters::vertex_point_map(points),
                                                CGAL::parameters::vertex_point_map(moved_points));
  EXPECT_GT(moved.faces.size(), 5U);
}

TEST_F(Snippets, of_first_impact) {
  const Surface_mesh sheet = lodestone::grid(5, 5);
  Surface_mesh ball = lodestone::sphere(3, 0.25, {2, 2, 1});
  const auto next_sheet = get(CGAL::vertex_point, sheet);
  const auto next_ball = get(CGAL::dynamic_vertex_property_t<lodestone::Point>(), ball);
  for (const auto v : ball.vertices()) {
    const lodestone::Point& p = ball.point(v);
    put(next_ball, v, lodestone::Point(p.x(), p.y(), p.z() - 2));
  }
  double stopped = 0;
  const auto stop = [&](double time, const lodestone::Face_pair& /*faces*/, const lodestone::Point& /*point*/) {
    stopped = time;
  };

  const auto impact = lodestone::find_first_impact(sheet, next_sheet, ball, next_ball);
  if (impact) stop(impact->time, impact->faces, impact->point);

  EXPECT_EQ(stopped, 0.375);
}

TEST_F(Snippets, of_one_call_for_one_mesh) {
  lodestone::append(mesh, mesh_b);
  const auto found = lodestone::find_self_collisions(mesh);
  for (const auto& [face_a, face_b] : found.faces) respond(face_a, face_b);
  EXPECT_EQ(responses, found.faces.size());
  EXPECT_GT(responses, 0U);
}

TEST_F(Snippets, of_meshes_that_move) {
  lodestone::Detector detector({.contacts = lodestone::Contact_query::first});
  const auto cloth = detector.add(cloth_mesh), body = detector.add(body_mesh);
  while (move(cloth_mesh, body_mesh)) {  // vertices only; connectivity stays
    const lodestone::Frame& frame = detector.detect();
    for (const auto& pair : frame.pairs)
      if (pair.collides)
        for (const auto& [face_a, face_b] : frame.contacts(pair)) respond(face_a, face_b);
  }
  EXPECT_LT(cloth, body);
  EXPECT_GT(responses, 0U);
}

TEST_F(Snippets, of_arrays) {
  const auto arrays_of = [](const Surface_mesh& given) {
    std::vector<double> coordinates;
    for (const auto& p : given.points()) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    return coordinates;
  };
  auto cloth_coordinates = arrays_of(cloth_mesh);
  const auto body_coordinates = arrays_of(body_mesh);
  const auto cloth_faces = lodestone::Mesh_numbering(cloth_mesh).corners();
  const auto body_faces = lodestone::Mesh_numbering(body_mesh).corners();
  std::size_t colliding_frames = 0;
  {
    const lodestone::Indexed_mesh cloth(cloth_coordinates, cloth_faces);  // x, y, z per vertex; corners per face
    const lodestone::Indexed_mesh body(body_coordinates, body_faces);
    lodestone::Detector detector;
    detector.add(cloth), detector.add(body);
    for (std::size_t i = 0; i < cloth_coordinates.size(); i += 3) cloth_coordinates[i] += 0.75;  // read where they are
    if (detector.detect().collides()) ++colliding_frames;
  }
  EXPECT_EQ(colliding_frames, 1U);
}

TEST_F(Snippets, of_particles) {
  std::size_t colliding_frames = 0;
  lodestone::Detector detector({.mode = lodestone::Mode::particles, .particles = 32});
  detector.add(cloth_mesh), detector.add(body_mesh);
  while (move(cloth_mesh, body_mesh)) {
    detector.update();  // before each detect: repartitions what has grown
    if (detector.detect().collides()) ++colliding_frames;
  }
  EXPECT_GT(colliding_frames, 0U);
}

TEST_F(Snippets, of_more_than_face_pairs) {
  double least_distance = std::numeric_limits<double>::infinity(), longest_way_out = 0;
  lodestone::Detector detector({.contact_points = true,
                                .contact_normals = true,
                                .exact = {.tolerance = 0.001, .self_collision = true, .containment = true},
                                .threads = 0});
  const auto cloth = detector.add(cloth_mesh), body = detector.add(body_mesh, {.groups = 2, .meets = 1});
  while (move(cloth_mesh, body_mesh)) {
    const auto held = detector.hold_positions();        // none moves until the end of this round
    const lodestone::Frame& frame = detector.detect();  // reads the positions, refits, answers
    for (const auto& pair : frame.pairs)                // a = b: the cloth with itself
      for (std::size_t i = pair.first_contact; i < pair.first_contact + pair.contacts; ++i)
        push(pair, frame.face_pairs[i], frame.contact_points[i], frame.contact_normals[i]);
    least_distance = std::min(least_distance, detector.closest(cloth, body).points.distance);
    if (const auto way_out = detector.parting(cloth, body))
      longest_way_out = std::max(longest_way_out, way_out->length);
  }
  EXPECT_GT(pushes, 0U);
  EXPECT_EQ(least_distance, 0);
  EXPECT_GT(longest_way_out, 0);
}

class Certified_snippet : public Snippets {
 protected:
  bool certified(const Surface_mesh& arm_mesh, lodestone::Skinned_points& arm_points, const Eigen::Affine3d& shoulder,
                 const Eigen::Affine3d& elbow) {
    const Eigen::Vector3d eye(0, 0, 9), towards(0, 0, -1);
    lodestone::Detector detector({.mode = lodestone::Mode::certified});
    const auto arm = detector.add(arm_mesh, point_map(arm_mesh, arm_points));  // bounded by its joints
    const auto body = detector.add(body_mesh);                                 // read as a whole
    arm_points.set_joints(std::vector{shoulder, elbow});                       // the next pose
    const lodestone::Frame& frame = detector.detect();
    const auto hit = detector.first_hit(arm, {.origin = eye, .direction = towards});
    EXPECT_NE(arm, body);
    EXPECT_TRUE(!hit || hit->t > 0);
    return frame.collides();
  }
};

TEST_F(Certified_snippet, of_computed_positions) {
  const Surface_mesh& arm_mesh = cloth_mesh;
  std::vector<double> rest, weights;
  std::vector<std::uint32_t> joints;
  for (const auto v : arm_mesh.vertices()) {
    for (int axis = 0; axis < 3; ++axis) rest.push_back(arm_mesh.point(v)[axis]);
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {0.5, 0.5, 0, 0});
  }
  const Eigen::Affine3d shoulder = Eigen::Affine3d::Identity(), elbow = shoulder;
  lodestone::Skinned_points arm(rest, lodestone::Joint_influences::of(4, joints, weights), 2);
  lodestone::Detector detector;
  detector.add(arm_mesh, point_map(arm_mesh, arm));
  detector.add(body_mesh);
  arm.set_joints(std::vector{shoulder, elbow});  // the next pose
  const bool hit = detector.detect().collides();

  EXPECT_EQ(hit, !detector.detect().face_pairs.empty());
  lodestone::Skinned_points& arm_points = arm;
  const bool same = certified(arm_mesh, arm_points, shoulder, elbow);
  EXPECT_EQ(same, hit);
}

TEST_F(Snippets, of_promises) {
  std::size_t colliding_frames = 0;
  const double farthest_step = 10;
  lodestone::Displacement_promise cloth_moves;
  lodestone::Detector detector({.mode = lodestone::Mode::certified});
  const auto cloth = detector.add(cloth_mesh);
  detector.add(body_mesh);
  detector.promise(cloth, cloth_moves);
  while (move(cloth_mesh, body_mesh)) {
    cloth_moves.move(farthest_step);  // no vertex of the cloth has moved farther since the last call
    if (detector.detect().collides()) ++colliding_frames;
  }
  EXPECT_GT(colliding_frames, 0U);
}

TEST_F(Snippets, of_saved_objects) {
  const lodestone::test::Temporary_folder folder;
  const Working_folder here(folder.path());
  for (int run = 0; run < 2; ++run) {
    lodestone::Detector detector;
    const auto cloth = detector.add(cloth_mesh);
    if (std::filesystem::exists("cloth.object"))
      lodestone::load_object(detector, cloth, "cloth.object");
    else
      lodestone::save_object(detector, cloth, "cloth.object");
    EXPECT_EQ(detector.detect().statistics.builds, run == 0 ? 1U : 0U);
  }
}

TEST_F(Snippets, of_vertices_that_a_file_has_once) {
  const lodestone::test::Temporary_folder folder;
  folder.write("two_boxes_on_an_edge.off",
               "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const Working_folder here(folder.path());
  lodestone::Detector detector;
  const lodestone::Mesh_file file = lodestone::read_mesh("two_boxes_on_an_edge.off");
  detector.add(file.mesh, {.file_vertex = file.file_vertex});
  EXPECT_FALSE(detector.detect().collides());
}

TEST_F(Snippets, of_the_partition_stage) {
  using Mesh = lodestone::Surface_mesh;
  auto regions = mesh.add_property_map<Mesh::Vertex_index, lodestone::Region_index>("v:part").first;
  const auto partition = lodestone::lbg(mesh, 32, regions, {.features = {.normal_weight = 0.5}});
  EXPECT_GT(partition.regions, 1U);

  const auto curvature = mesh.add_property_map<Mesh::Vertex_index, double>("v:curvature", 1).first;
  const lodestone::Lbg strategy{.extra_factors = lodestone::factors(mesh, curvature, 0.2)};
  lodestone::partition(mesh, 32, regions, strategy);

  for (Surface_mesh* other : {&mesh_a, &mesh_b})
    other->add_property_map<CGAL::SM_Vertex_index, double>("v:curvature", 1);
  lodestone::Detector<Lbg_with_curvature> detector({.mode = lodestone::Mode::particles}, {});
  detector.add(mesh_a), detector.add(mesh_b);
  EXPECT_TRUE(detector.detect().collides());
}

TEST_F(Snippets, of_a_strategy_of_ones_own) {
  const auto region_map = mesh.add_property_map<Surface_mesh::Vertex_index, lodestone::Region_index>("v:region").first;
  const auto divided = lodestone::partition(mesh, 32, region_map, Slices{});
  const auto measures = lodestone::measure_partition(mesh, divided, region_map);
  lodestone::Detector<Slices> detector({.mode = lodestone::Mode::particles, .particles = 32}, Slices{});
  EXPECT_EQ(measures.regions, divided.regions);
  detector.add(mesh_a), detector.add(mesh_b);
  EXPECT_TRUE(detector.detect().collides());
}

TEST_F(Snippets, of_a_promise_of_ones_own) {
  Surface_mesh stone_mesh = lodestone::sphere(8, 1, {0.1, 0.2, 2.6});
  const Surface_mesh rest = stone_mesh, ground_mesh = lodestone::sphere(6);
  const auto lower = [&rest](Surface_mesh& fallen_mesh, double fallen) {
    for (const auto v : fallen_mesh.vertices()) {
      const lodestone::Point& at = rest.point(v);
      fallen_mesh.point(v) = {at.x(), at.y(), at.z() - fallen};
    }
  };
  Falling_promise falls;
  lodestone::Detector detector({.mode = lodestone::Mode::certified});
  const auto stone = detector.add(stone_mesh);
  detector.add(ground_mesh);
  detector.promise(stone, falls);
  detector.detect();  // the stone is at rest
  while (!detector.detect().collides()) {
    falls.fallen += 0.125;
    lower(stone_mesh, falls.fallen);  // z is that at rest minus this
  }
  EXPECT_GT(falls.fallen, 0);
  EXPECT_LT(falls.fallen, 2.6);
  EXPECT_EQ(detector.detect().statistics.violations, 0U);
  lodestone::Detector exact;
  exact.add(stone_mesh), exact.add(ground_mesh);
  EXPECT_EQ(detector.detect().face_pairs, exact.detect().face_pairs);
}

TEST_F(Snippets, of_points_of_ones_own) {
  const Surface_mesh reed_mesh = lodestone::sphere(8, 1, {0.4, 0, 1});
  std::size_t colliding_frames = 0;
  Leaning_points reed(reed_mesh);
  lodestone::Lipschitz_promise leans(1, 1e-12);
  lodestone::Detector detector({.mode = lodestone::Mode::certified});
  const auto plant = detector.add(reed_mesh, lodestone::point_map(reed_mesh, reed));
  detector.add(body_mesh);
  detector.promise(plant, leans);
  for (const double lean : {0.0, 0.25, 0.5, 0.75}) {
    reed.set_lean(lean);
    leans.set_constant(1 + lean, 1e-12);
    if (detector.detect().collides()) ++colliding_frames;
  }
  EXPECT_GT(colliding_frames, 0U);
  EXPECT_LT(colliding_frames, 4U);
  EXPECT_EQ(detector.detect().statistics.violations, 0U);
  EXPECT_NE(detector.bounded(plant), nullptr);
}

}  // namespace
