// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/particle_object.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "lodestone/partition/lbg.h"
#include "support/counting_points.h"
#include "support/special_numbers.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// A mesh as an object whose reads are counted.
struct Counted_object {
  Surface_mesh mesh;
  std::size_t reads = 0;
  Particle_object object;

  explicit Counted_object(const Surface_mesh& shape)
      : mesh(shape),
        object(std::make_unique<Typed_watched_mesh<Surface_mesh, Counting_points, Lbg>>(
            mesh, Counting_points{&mesh, &reads}, std::make_shared<const Lbg>())) {
    object.find_edges();
  }
  Counted_object(const Surface_mesh& shape, std::size_t regions) : Counted_object(shape) { partition(regions); }

  void partition(std::size_t regions, const Partition_options& options = {}) {
    const Positions positions = object.read_positions();
    object.measure_distance(positions, Distance_measure::adjacent_vertices);
    object.take_division(object.divide(positions, regions, options), positions);
    object.prepare_patches();
  }
  void scatter(std::size_t particles, const Senin_options& options = {}) {
    const Positions positions = object.read_positions();
    object.measure_distance(positions, Distance_measure::adjacent_vertices);
    object.scatter(positions, particles, options);
  }
  Eigen::Vector3d at(std::uint32_t vertex) const { return coordinates(mesh.point(Surface_mesh::Vertex_index(vertex))); }
};

/// Turns a mesh around an axis through the origin that lies along none of the coordinate axes.
void turn(Surface_mesh& mesh, double angle) {
  const Eigen::AngleAxisd rotation(angle, Eigen::Vector3d(1, -2, 3).normalized());
  deform(mesh, [&](const Point& p) {
    const Eigen::Vector3d q = rotation * coordinates(p);
    return Point(q.x(), q.y(), q.z());
  });
}

void expect_pose(Counted_object& counted, std::size_t particle, std::uint64_t frame) {
  const Posed_patch& posed = counted.object.posed_patch(particle, frame);
  ASSERT_EQ(posed.patch, &counted.object.patches()[particle]);
  ASSERT_EQ(posed.positions.size(), posed.patch->vertices.size());
  for (std::size_t i = 0; i < posed.positions.size(); ++i) {
    EXPECT_EQ(posed.positions[i], counted.at(posed.patch->vertices[i]));
    EXPECT_TRUE(posed.box.contains(posed.positions[i]));
  }
}

TEST(Particle_object, has_a_particle_and_a_patch_for_each_region) {
  for (const std::size_t regions : {1, 2, 7, 32}) {
    const Counted_object counted(potato(8), regions);
    const auto& object = counted.object;
    EXPECT_EQ(1U + std::ranges::max(object.labels()), regions);
    ASSERT_EQ(object.particles().at.size(), regions);
    ASSERT_EQ(object.particles().positions.size(), regions);
    ASSERT_EQ(object.patches().size(), regions);
    for (Region_index region = 0; region < regions; ++region) {
      const auto vertex = object.particles().at[region];
      EXPECT_EQ(object.labels()[vertex], region);
      EXPECT_EQ(object.particles().positions[region], counted.at(vertex));
    }
  }
}

TEST(Particle_object, the_patch_of_a_region_holds_the_faces_with_a_corner_in_it) {
  const Counted_object counted(potato(8), 12);
  const auto& object = counted.object;
  for (Region_index region = 0; region < 12; ++region) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = 0; f < object.corners().size(); ++f)
      if (std::ranges::any_of(object.corners()[f], [&](auto v) { return object.labels()[v] == region; }))
        faces.push_back(f);
    EXPECT_EQ(object.patches()[region].faces, faces);
  }
}

TEST(Particle_object, measures_of_the_particles_are_those_of_their_vertices) {
  const Counted_object counted(potato(8), 12);
  const Numbered_mesh mesh(counted.mesh);
  const auto& particles = counted.object.particles();
  double longest = 0;
  std::size_t hops = 0;
  for (const auto a : particles.at)
    for (const auto b : particles.at) {
      longest = std::max(longest, (counted.at(a) - counted.at(b)).norm());
      hops = std::max<std::size_t>(hops, breadth_first_hops(mesh.graph, a)[b]);
    }
  EXPECT_NEAR(particles.effective_radius, longest, 1e-14);
  EXPECT_EQ(particles.hop_limit, hops);
  double edges = 0;
  for (const auto e : counted.mesh.edges())
    edges += (counted.at(counted.mesh.vertex(e, 0)) - counted.at(counted.mesh.vertex(e, 1))).norm();
  EXPECT_NEAR(particles.collision_distance, edges / double(num_edges(counted.mesh)), 1e-14);
}

TEST(Particle_object, a_partition_reads_nothing_but_the_positions_that_it_is_given) {
  Counted_object counted(potato(8));
  const Positions positions = counted.object.read_positions();
  EXPECT_EQ(counted.reads, positions.rows());
  counted.reads = 0;
  counted.object.measure_distance(positions, Distance_measure::adjacent_vertices);
  counted.object.take_division(counted.object.divide(positions, 12, {}), positions);
  counted.object.prepare_meetings(positions, {});
  EXPECT_EQ(counted.reads, 0U);
}

TEST(Particle_object, reads_one_vertex_for_each_particle) {
  Counted_object counted(potato(8), 12);
  shift(counted.mesh, 5);
  counted.reads = 0;
  counted.object.read_particles();
  EXPECT_EQ(counted.reads, 12U);
  const auto& particles = counted.object.particles();
  for (std::size_t p = 0; p < 12; ++p) EXPECT_EQ(particles.positions[p], counted.at(particles.at[p]));
}

TEST(Particle_object, a_patch_is_posed_as_it_is_in_the_frame_asked_for_and_read_once_a_frame) {
  Counted_object counted(potato(8), 12);
  for (std::uint64_t frame = 1; frame < 4; ++frame) {
    shift(counted.mesh, 1, 0.3);
    for (std::size_t p = 0; p < 12; ++p) {
      counted.reads = 0;
      expect_pose(counted, p, frame);
      EXPECT_EQ(counted.reads, counted.object.patches()[p].vertices.size());
      expect_pose(counted, p, frame);
      EXPECT_EQ(counted.reads, counted.object.patches()[p].vertices.size());
    }
  }
}

TEST(Particle_object, a_new_partition_poses_its_patches_anew_within_a_frame) {
  Counted_object counted(potato(8), 12);
  for (std::size_t p = 0; p < 12; ++p) expect_pose(counted, p, 1);
  scale(counted.mesh, 2);
  counted.partition(20);
  ASSERT_EQ(counted.object.patches().size(), 20U);
  for (std::size_t p = 0; p < 20; ++p) expect_pose(counted, p, 1);
}

TEST(Particle_object, a_patch_with_a_coordinate_that_is_not_finite_is_refused) {
  for (const double bad : {not_a_number, infinity}) {
    Counted_object counted(potato(8), 12);
    counted.mesh.point(Surface_mesh::Vertex_index(counted.object.patches()[3].vertices[0])) = Point(0, 0, bad);
    EXPECT_THROW(counted.object.posed_patch(3, 1), Bad_mesh);
  }
}

TEST(Particle_object, looked_at_one_region_per_call_is_looked_at_everywhere) {
  for (Region_index grown = 0; grown < 6; ++grown) {
    Counted_object counted(grid(17, 17), 6);
    const auto& labels = counted.object.labels();
    const auto home = counted.at(counted.object.particles().at[grown]);
    for (const auto v : counted.mesh.vertices())
      if (labels[v] == grown) {
        const Eigen::Vector3d p = home + 20 * (counted.at(v) - home);
        counted.mesh.point(v) = Point(p.x(), p.y(), p.z());
      }
    bool outgrown = false;
    for (int call = 0; call < 6; ++call) outgrown |= counted.object.has_outgrown(2, 1);
    EXPECT_TRUE(outgrown) << grown;
  }
}

TEST(Particle_object, has_not_outgrown_itself_when_nothing_has_moved) {
  for (const auto& mesh : {potato(8), sphere(8), grid(9, 9), cube(4), single_triangle()})
    for (const std::size_t regions : {1, 3, 24})
      EXPECT_FALSE(Counted_object(mesh, regions).object.has_outgrown(1)) << regions;
}

TEST(Particle_object, rigid_motion_is_no_growth) {
  for (const auto& mesh : {potato(8), sphere(8), grid(9, 9)}) {
    Counted_object counted(mesh, 24);
    turn(counted.mesh, 2.1);
    shift(counted.mesh, 3, -7, 0.4);
    EXPECT_FALSE(counted.object.has_outgrown(1));
  }
}

TEST(Particle_object, spinning_is_no_growth) {
  for (const auto& mesh : {potato(8), sphere(8), cube(6)}) {
    Counted_object counted(mesh, 24);
    for (int step = 0; step < 100; ++step) {
      turn(counted.mesh, 0.37);
      ASSERT_FALSE(counted.object.has_outgrown(1)) << step;
    }
  }
}

TEST(Particle_object, shrinking_is_no_growth) {
  Counted_object counted(potato(8), 24);
  for (const double factor : {0.9, 0.1, 0.0}) {
    scale(counted.mesh, factor);
    EXPECT_FALSE(counted.object.has_outgrown(1));
  }
}

TEST(Particle_object, has_outgrown_itself_when_areas_have_grown_beyond_the_limit) {
  for (const auto& mesh : {potato(8), sphere(8), grid(9, 9)}) {
    Counted_object counted(mesh, 24);
    ASSERT_GT(counted.object.largest_area(), 0);
    scale(counted.mesh, 1.2);  // areas by 1.44
    EXPECT_TRUE(counted.object.has_outgrown(1));
    EXPECT_TRUE(counted.object.has_outgrown(1.43));
    EXPECT_FALSE(counted.object.has_outgrown(1.45));
    EXPECT_FALSE(counted.object.has_outgrown(2));
    EXPECT_FALSE(counted.object.has_outgrown(infinity));
  }
}

TEST(Particle_object, a_new_partition_is_the_measure_of_growth_from_then_on) {
  Counted_object counted(potato(8), 24);
  const double before = counted.object.largest_area();
  scale(counted.mesh, 2);
  ASSERT_TRUE(counted.object.has_outgrown(1));
  counted.partition(24);
  EXPECT_NEAR(counted.object.largest_area(), 4 * before, 1e-9 * before);
  EXPECT_FALSE(counted.object.has_outgrown(1));
  scale(counted.mesh, 1.2);
  EXPECT_TRUE(counted.object.has_outgrown(1));
}

TEST(Particle_object, growth_is_looked_for_at_no_more_than_twenty_reads_a_region) {
  Counted_object counted(sphere(40), 12);
  turn(counted.mesh, 1);
  counted.reads = 0;
  EXPECT_FALSE(counted.object.has_outgrown(1.01));
  EXPECT_LE(counted.reads, 12 * 20U);
}

TEST(Particle_object, growth_is_noticed_where_every_region_is_a_single_vertex) {
  for (const auto& mesh : {tetrahedron(), potato(2)}) {
    Counted_object counted(mesh, num_vertices(mesh));
    ASSERT_EQ(counted.object.particles().at.size(), num_vertices(mesh));
    ASSERT_EQ(counted.object.largest_area(), 0);
    EXPECT_FALSE(counted.object.has_outgrown(1));
    turn(counted.mesh, 1.3);
    EXPECT_FALSE(counted.object.has_outgrown(1));
    scale(counted.mesh, 4);
    EXPECT_TRUE(counted.object.has_outgrown(1));
    EXPECT_FALSE(counted.object.has_outgrown(infinity));
    counted.partition(num_vertices(mesh));
    EXPECT_FALSE(counted.object.has_outgrown(1));
  }
}

TEST(Particle_object, growth_is_noticed_where_all_vertices_lay_on_each_other) {
  auto mesh = potato(4);
  scale(mesh, 0);
  Counted_object counted(mesh, 12);
  EXPECT_FALSE(counted.object.has_outgrown(1));
  shift(counted.mesh, 1);
  EXPECT_FALSE(counted.object.has_outgrown(1));
  counted.mesh = potato(4);
  EXPECT_TRUE(counted.object.has_outgrown(1));
}

TEST(Particle_object, growth_is_still_noticed_after_a_frame_that_was_not_finite) {
  for (const double bad : {not_a_number, infinity})
    for (const std::size_t regions : {std::size_t{1}, std::size_t{24}, std::size_t{num_vertices(potato(4))}}) {
      Counted_object counted(potato(4), regions);
      const Surface_mesh finite = counted.mesh;
      deform(counted.mesh, [&](const Point&) { return Point(bad, bad, bad); });
      EXPECT_THROW(counted.object.has_outgrown(1), Bad_mesh) << regions;
      for (const auto v : finite.vertices()) counted.mesh.point(v) = finite.point(v);
      EXPECT_FALSE(counted.object.has_outgrown(1)) << regions;
      scale(counted.mesh, 1.2);
      EXPECT_TRUE(counted.object.has_outgrown(1)) << regions;
    }
}

TEST(Particle_object, a_particle_with_a_coordinate_that_is_not_finite_is_refused) {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    Counted_object counted(potato(4), 12);
    counted.mesh.point(Surface_mesh::Vertex_index(counted.object.particles().at[5])) = Point(0, bad, 0);
    EXPECT_THROW(counted.object.read_particles(), Bad_mesh);
  }
}

TEST(Particle_object, a_mesh_that_has_been_emptied_is_refused) {
  Counted_object counted(potato(4), 12);
  counted.mesh.clear();
  EXPECT_THROW(counted.object.read_particles(), Bad_mesh);
  EXPECT_THROW(counted.object.has_outgrown(1), Bad_mesh);
}

TEST(Particle_object, a_mesh_with_another_vertex_is_refused) {
  Counted_object counted(potato(4), 12);
  EXPECT_NO_THROW(counted.object.read_particles());
  counted.mesh.add_vertex(Point(0, 0, 0));
  EXPECT_THROW(counted.object.read_particles(), Bad_mesh);
}

TEST(Particle_object, a_mesh_with_another_face_is_refused) {
  auto mesh = grid(4, 4);
  const std::array corners{mesh.add_vertex({0, 9, 0}), mesh.add_vertex({1, 9, 0}), mesh.add_vertex({0, 10, 0})};
  Counted_object counted(mesh, 4);
  EXPECT_NO_THROW(counted.object.read_particles());
  ASSERT_NE(counted.mesh.add_face(corners[0], corners[1], corners[2]), Surface_mesh::null_face());
  EXPECT_THROW(counted.object.read_particles(), Bad_mesh);
}

TEST(Particle_object, coordinates_whose_squares_overflow_are_refused) {
  for (const std::size_t regions : {1, 12}) {
    for (const double factor : {1e151, 1e200, 1e300}) {
      auto mesh = sphere(4);
      scale(mesh, factor);
      EXPECT_THROW(Counted_object(mesh, regions), Bad_mesh) << factor;
      auto far = sphere(4);
      shift(far, 0, -factor, 0);
      EXPECT_THROW(Counted_object(far, regions), Bad_mesh) << factor;
    }
    auto mesh = sphere(4);
    scale(mesh, 1e148);
    EXPECT_NO_THROW(Counted_object(mesh, regions));
  }
}

TEST(Particle_object, edges_whose_squares_vanish_are_refused) {
  for (const std::size_t regions : {1, 12}) {
    for (const double factor : {1e-152, 1e-200, 1e-300}) {
      auto mesh = sphere(4);
      scale(mesh, factor);
      EXPECT_THROW(Counted_object(mesh, regions), Bad_mesh) << factor;
    }
    auto mesh = sphere(4);
    scale(mesh, 1e-148);
    EXPECT_NO_THROW(Counted_object(mesh, regions));
  }
}

TEST(Particle_object, a_single_particle_reaches_as_far_as_the_object_is_wide) {
  const Counted_object counted(sphere(8, 1.5, {4, 0, 0}), 1);
  ASSERT_EQ(counted.object.particles().at.size(), 1U);
  EXPECT_NEAR(counted.object.particles().effective_radius, 3, 1e-9);
}

TEST(Particle_object, a_single_particle_may_walk_to_the_vertex_farthest_from_it) {
  for (const auto& mesh : {sphere(8), potato(6), grid(9, 3)}) {
    const Counted_object counted(mesh, 1);
    const auto hops = breadth_first_hops(Numbered_mesh(mesh).graph, counted.object.particles().at[0]);
    EXPECT_EQ(counted.object.particles().hop_limit, std::ranges::max(hops));
  }
}

TEST(Particle_object, a_single_particle_does_not_walk_to_other_components) {
  // With both components in one region only the one that the particle is on counts.
  auto mesh = grid(3, 3);
  auto other = grid(3, 3);
  shift(other, 10);
  append(mesh, other);
  Counted_object counted(mesh);
  counted.partition(1, {.keep_islands = true});
  const auto at = counted.object.particles().at;
  ASSERT_EQ(at.size(), 1U);
  std::uint32_t farthest = 0;
  for (const auto hops : breadth_first_hops(Numbered_mesh(mesh).graph, at[0]))
    if (hops != unreached) farthest = std::max(farthest, hops);
  EXPECT_EQ(counted.object.particles().hop_limit, farthest);
}

TEST(Particle_object, two_single_particles_walk_towards_each_other) {
  Counted_object a(sphere(8), 1), b(sphere(8), 1);
  const auto particle_of = [](Counted_object& counted) -> Particles& { return counted.object.particles(); };
  // The particle of b beyond a neighbour of that of a: the neighbour is nearer to it.
  const auto start = a.at(particle_of(a).at[0]);
  const auto reach = a.object.steps().from(particle_of(a).at[0]);
  const auto neighbour = a.at(reach[reach[0] == particle_of(a).at[0] ? 1 : 0]);
  const Eigen::Vector3d wanted = start + 1.2 * (neighbour - start).normalized();
  const Eigen::Vector3d move = wanted - b.at(particle_of(b).at[0]);
  shift(b.mesh, move.x(), move.y(), move.z());
  for (auto* counted : {&a, &b}) counted->object.read_particles();

  using Walker = Walking_object<Live_positions>;
  const std::vector<std::uint32_t> near_a{1}, near_b{0};
  const auto walker = [](Counted_object& counted, std::span<const std::uint32_t> near) {
    return Walker{.particles = &counted.object.particles(),
                  .steps = &counted.object.steps(),
                  .reader = &counted.object.positions(),
                  .opponents = near};
  };
  const std::vector<Walker> walkers{walker(a, near_a), walker(b, near_b)};
  Relaxation_scratch scratch;
  scratch.reserve(std::vector<std::size_t>{1, 1});
  const auto relaxation = relax(std::span<const Walker>(walkers), scratch);
  EXPECT_GE(relaxation.moves, 1U);
  EXPECT_GE(relaxation.iterations, 2U);
  EXPECT_LT((particle_of(a).positions[0] - particle_of(b).positions[0]).norm(), 1.2);
}

TEST(Scattered_object, has_a_patch_for_each_particle) {
  Counted_object counted(potato(8));
  counted.scatter(20);
  EXPECT_EQ(counted.object.particles().at.size(), 20U);
  EXPECT_EQ(counted.object.patches().size(), 20U);
  EXPECT_EQ(std::ranges::max(counted.object.labels()), 0U);
  for (std::size_t p = 0; p < 20; ++p) expect_pose(counted, p, 1);
}

/// The faces with a corner at most `rings` hops from a vertex, by searching the whole mesh.
std::vector<std::uint32_t> faces_around(const Surface_mesh& mesh, std::uint32_t centre, std::uint32_t rings) {
  const Numbered_mesh numbered(mesh);
  const auto hops = breadth_first_hops(numbered.graph, centre);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < numbered.faces.size(); ++f)
    if (std::ranges::any_of(numbered.faces[f], [&](auto v) { return hops[v] <= rings; })) faces.push_back(f);
  return faces;
}

TEST(Particle_object, closes_its_seams_anew_where_they_are_when_they_are_closed_again) {
  const Surface_mesh whole = sphere(3), apart = flat_shaded(whole);
  Counted_object counted(apart);
  const std::size_t all_joined = num_vertices(apart) - num_vertices(whole);
  const auto lift_first_face = [&](double height) {
    for (const auto corner : {0U, 1U, 2U}) {
      const Surface_mesh::Vertex_index v(corner);
      const Point& p = apart.point(v);
      counted.mesh.point(v) = Point(p.x(), p.y(), p.z() + height);
    }
  };
  const auto joined = [&] {
    counted.object.close_seams(counted.object.read_positions());
    return counted.object.joined_vertices();
  };
  for (int call = 0; call < 3; ++call) EXPECT_EQ(joined(), all_joined) << call;
  lift_first_face(2);
  EXPECT_EQ(joined(), all_joined - 3);
  lift_first_face(0);
  EXPECT_EQ(joined(), all_joined);
}

TEST(Scattered_object, the_patch_around_a_particle_follows_it) {
  Counted_object counted(potato(8));
  counted.scatter(6, {.rings = 2});
  for (const std::uint32_t step : {0, 5, 17}) {
    for (std::size_t p = 0; p < 6; ++p) {
      std::uint32_t& at = counted.object.particles().at[p];
      at = (at + step) % static_cast<std::uint32_t>(num_vertices(counted.mesh));
      expect_pose(counted, p, 1);  // in one frame: the place matters
      EXPECT_EQ(counted.object.patches()[p].faces, faces_around(counted.mesh, at, 2));
    }
  }
}

TEST(Scattered_object, a_patch_whose_particle_rests_is_read_once_a_frame) {
  Counted_object counted(potato(8));
  counted.scatter(6, {.rings = 1});
  counted.object.posed_patch(2, 1);
  counted.reads = 0;
  counted.object.posed_patch(2, 1);
  EXPECT_EQ(counted.reads, 0U);
  counted.object.posed_patch(2, 2);
  EXPECT_EQ(counted.reads, counted.object.patches()[2].vertices.size());
}

TEST(Scattered_object, coordinates_out_of_range_are_refused) {
  for (const double factor : {1e151, 1e-152}) {
    auto mesh = sphere(4);
    scale(mesh, factor);
    Counted_object counted(mesh);
    EXPECT_THROW(counted.scatter(6), Bad_mesh) << factor;
  }
}

}  // namespace
}  // namespace lodestone
