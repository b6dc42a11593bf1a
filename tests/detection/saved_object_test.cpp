// SPDX-License-Identifier: GPL-3.0-or-later
// An object that is loaded is as the one that was saved, and what does not fit is refused.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

#include "detection/detector_scenes.h"
#include "lodestone/detection/saved_object.h"
#include "lodestone/tree/tree_layout.h"
#include "lodestone/volumes/all.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

using Bytes = std::vector<std::byte>;

/// What is expected of the objects of one detector is found with those of another, which has loaded them.
struct Twins {
  Detector_options options;
  Owned_meshes meshes;
  Owned_meshes copies = meshes;
  Detector<> expected{options}, loaded{options};

  Twins(const Detector_options& o, Owned_meshes m) : options(o), meshes(std::move(m)) {
    lodestone::add_all(expected, meshes);
    lodestone::add_all(loaded, copies);
    for (Object_id id = 0; id < meshes.size(); ++id) loaded.load(id, expected.save(id));
  }

  /// @return contacts of all frames
  std::size_t expect_same_frames(int frames, const std::function<void(Owned_meshes&)>& move) {
    std::size_t contacts = 0;
    for (int frame = 0; frame < frames; ++frame) {
      const Frame& one = expected.detect();
      const Frame& other = loaded.detect();
      EXPECT_EQ(other.statistics.builds, 0U);
      EXPECT_EQ(one.statistics.vertices_read, other.statistics.vertices_read) << frame;
      expect_same_frame(one, other);
      contacts += other.face_pairs.size();
      move(meshes), move(copies);
      expected.update(), loaded.update();
    }
    return contacts;
  }
};

void approach(Owned_meshes& meshes) { shift(meshes[1], -0.05); }
void swell(Owned_meshes& meshes) {
  deform(meshes[0], [](const Point& p) { return Point(1.08 * p.x(), 1.02 * p.y(), p.z()); });
}

struct Saved_case {
  std::string name;
  Detector_options options;
  friend void PrintTo(const Saved_case& saved, std::ostream* out) { *out << saved.name; }
};

class Saved_object : public testing::TestWithParam<Saved_case> {};

TEST_P(Saved_object, gives_the_same_frames) {
  Twins twins(GetParam().options, two_spheres(2.2));
  EXPECT_GT(twins.expect_same_frames(12, approach), 0U);
  for (const auto v : twins.meshes[0].vertices())
    for (const char* name : {"v:region", "v:particle"}) {
      const auto map = [&](const Surface_mesh& mesh) {
        return mesh.property_map<Surface_mesh::Vertex_index, Region_index>(name).first;
      };
      ASSERT_EQ(map(twins.meshes[0])[v], map(twins.copies[0])[v]);
    }
}

TEST_P(Saved_object, gives_the_same_frames_when_surfaces_grow) {
  Twins twins(GetParam().options, two_spheres(2.2));
  EXPECT_GT(twins.expect_same_frames(12, swell), 0U);
}

TEST_P(Saved_object, of_triangles_that_share_no_vertices_gives_the_same_frames) {
  const Owned_meshes spheres = two_spheres(2.2, 6);
  Twins twins(GetParam().options, {flat_shaded(spheres[0]), flat_shaded(spheres[1])});
  EXPECT_GT(twins.expect_same_frames(12, approach), 0U);
}

TEST_P(Saved_object, is_saved_as_the_same_bytes_again) {
  Twins twins(GetParam().options, two_spheres(2.2));
  const Bytes saved = twins.expected.save(0);
  EXPECT_EQ(saved, twins.expected.save(0));
  EXPECT_EQ(saved, twins.loaded.save(0));
}

TEST_P(Saved_object, may_have_moved_meanwhile) {
  auto meshes = two_spheres(2.2);
  Detector first(GetParam().options), second(GetParam().options);
  add_all(first, meshes);
  const Bytes a = first.save(0), b = first.save(1);
  shift(meshes[1], -0.6);
  add_all(second, meshes);
  second.load(0, a), second.load(1, b);
  const Frame& frame = second.detect();
  EXPECT_EQ(expect_true(frame, meshes), 1U);
  EXPECT_EQ(frame.statistics.builds, 0U);
}

TEST_P(Saved_object, is_refused_where_the_mesh_or_the_mode_is_another) {
  auto meshes = two_spheres(1.8, 6);
  Detector detector(GetParam().options);
  add_all(detector, meshes);
  const Bytes saved = detector.save(0);
  Surface_mesh larger = sphere(7), flipped = meshes[0];
  CGAL::Euler::flip_edge(Surface_mesh::Halfedge_index(0), flipped);
  const auto refusal_of = [&](Surface_mesh& mesh, const Detector_options& options) -> std::string {
    Detector other(options);
    other.add(mesh, {.name = "ball"}), other.add(meshes[1]);
    try {
      other.load(0, saved);
    } catch (const Bad_saved_object& error) {
      EXPECT_EQ(expect_true(other.detect(), {mesh, meshes[1]}), 1U) << "the object stays as it was";
      return error.what();
    }
    return "none";
  };
  const Detector_options& options = GetParam().options;
  EXPECT_EQ(refusal_of(larger, options),
            "the object was saved with 146 vertices and 288 faces, but object 0 (ball) has 198 vertices and 392 faces");
  EXPECT_EQ(refusal_of(flipped, options), "object 0 (ball) has other faces than the object that was saved");
  Detector_options other{.particles = 12};
  if (options.mode == Mode::exact) other.mode = Mode::particles;
  const std::string mode_of_the_other = options.mode == Mode::exact ? "particles" : "exact with volumes of kind aabb";
  EXPECT_NE(refusal_of(meshes[0], other).find("but object 0 (ball) is in mode " + mode_of_the_other),
            std::string::npos);
  EXPECT_EQ(refusal_of(meshes[0], options), "none");
}

INSTANTIATE_TEST_SUITE_P(Modes, Saved_object,
                         testing::Values(Saved_case{"exact", {.mode = Mode::exact}},
                                         Saved_case{"exact_with_regions", {.mode = Mode::exact, .particles = 12}},
                                         Saved_case{"particles", {.mode = Mode::particles, .particles = 12}},
                                         Saved_case{"by_rule", {.mode = Mode::particles}},
                                         Saved_case{"without_meetings",
                                                    {.mode = Mode::particles, .particles = 32, .meetings = 0}},
                                         Saved_case{"senin", {.mode = Mode::senin, .particles = 32}}),
                         [](const auto& test) { return test.param.name; });

TEST(Saved_objects, without_meetings_are_none_of_a_detector_with_meetings) {
  auto meshes = two_spheres(1.8, 6);
  Detector published({.mode = Mode::particles, .meetings = 0}), meeting({.mode = Mode::particles});
  add_all(published, meshes), add_all(meeting, meshes);
  EXPECT_THROW(meeting.load(0, published.save(0)), Bad_saved_object);
  EXPECT_THROW(published.load(0, meeting.save(0)), Bad_saved_object);
}

TEST(Saved_objects, know_the_kind_of_their_volumes) {
  auto meshes = two_spheres(1.8, 6);
  Detector<> boxes;
  Volume_detector<Bounding_sphere> spheres, others;
  add_all(boxes, meshes), add_all(spheres, meshes), add_all(others, meshes);
  EXPECT_THROW(spheres.load(0, boxes.save(0)), Bad_saved_object);
  others.load(0, spheres.save(0)), others.load(1, spheres.save(1));
  expect_same_frame(spheres.detect(), others.detect());
}

TEST(Saved_objects, do_not_depend_on_threads) {
  auto meshes = two_spheres(1.8, 40);
  for (const auto mode : {Mode::exact, Mode::particles}) {
    Detector<> one({.mode = mode}), three({.mode = mode, .exact = {.threads = 3}});
    add_all(one, meshes), add_all(three, meshes);
    EXPECT_EQ(one.save(0), three.save(0));
  }
}

TEST(Saved_objects, serve_meshes_of_another_type_with_the_same_numbers) {
  auto meshes = two_spheres(1.8, 6);
  CGAL::Polyhedron_3<Kernel> polyhedron;
  CGAL::copy_face_graph(meshes[0], polyhedron);
  Detector<> first, second, third;
  first.add(polyhedron), first.add(meshes[1]);
  second.add(polyhedron), second.add(meshes[1]);
  second.load(0, first.save(0));
  expect_same_frame(first.detect(), second.detect());
}

TEST(Saved_objects, hold_the_positions_at_rest_that_a_tolerance_within_an_object_needs) {
  Surface_mesh mesh = grid(12, 12);
  const Detector_options tolerant{.exact = {.self_collision = true, .self_tolerance = 0.4}};
  Detector<> first(tolerant), second(tolerant), without;
  first.add(mesh), second.add(mesh), without.add(mesh);
  const Bytes saved = first.save(0);
  deform(mesh, [](const Point& p) { return p.x() > 5 ? Point(11 - p.x(), p.y(), 0.3) : p; });
  second.load(0, saved);
  const auto contacts = first.detect().face_pairs;
  EXPECT_GT(contacts.size(), 20U);
  EXPECT_EQ(second.detect().face_pairs, contacts);
  EXPECT_THROW(second.load(0, without.save(0)), Bad_saved_object);
  EXPECT_EQ(second.detect().face_pairs, contacts);
}

TEST(Saved_objects, can_change_afterwards) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector first, second;
  first.add(a), second.add(a), second.add(b);
  second.load(0, first.save(0));
  const auto centre = CGAL::Euler::add_center_vertex(Surface_mesh::Halfedge_index(0), a);
  a.point(a.target(centre)) = {1.2, 0, 0};
  const std::uint32_t changed[] = {a.face(Surface_mesh::Halfedge_index(0))};
  second.rebuild(0, Changed_faces{changed});
  EXPECT_EQ(expect_exhaustive(second.detect(), {&a, &b}), 1U);
  crumple(a, 0.5, 1);  // until its tree is loose
  EXPECT_EQ(expect_exhaustive(second.detect(), {&a, &b}), 1U);
  EXPECT_EQ(second.detect().statistics.builds, 0U);
}

TEST(Saved_objects, can_change_where_leaves_hold_fewer_faces) {
  auto a = sphere(25);
  const auto b = sphere(25, 1, {1.9, 0, 0});
  Exact_detector first, second({.exact = {.tree = {.leaf_faces = 16}}});
  first.add(a), second.add(a), second.add(b);
  second.load(0, first.save(0));
  const auto centre = CGAL::Euler::add_center_vertex(Surface_mesh::Halfedge_index(0), a);
  a.point(a.target(centre)) = {1.2, 0, 0};
  const std::uint32_t changed[] = {a.face(Surface_mesh::Halfedge_index(0))};
  second.rebuild(0, Changed_faces{changed});
  EXPECT_EQ(expect_exhaustive(second.detect(), {&a, &b}), 1U);
}

TEST(Saved_objects, keep_the_placement_and_the_given_positions_of_the_object_that_loads) {
  auto a = sphere(12), b = sphere(12, 1, {5, 0, 0});
  Exact_detector first, second;
  first.add(a), second.add(a), second.add(b);
  const Eigen::Isometry3d there(Eigen::Translation3d(3.2, 0, 0));
  second.place(0, there);
  second.load(0, first.save(0));
  EXPECT_EQ(second.detect().pairs.size(), 1U);
  second.place(0, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(second.detect().pairs.empty());
}

TEST(Saved_objects, are_refused_by_a_strategy_that_cannot_divide_closed_seams) {
  Surface_mesh mesh = flat_shaded(sphere(6));
  const Detector_options options{.mode = Mode::particles};
  Detector<Lbg> first(options);
  Detector<By_vertex_number> second(options);
  first.add(mesh), second.add(mesh);
  EXPECT_THROW(second.load(0, first.save(0)), Bad_saved_object);
}

TEST(Saved_objects, without_closed_seams_open_those_of_the_object_that_loads) {
  Owned_meshes meshes{flat_shaded(sphere(6)), flat_shaded(sphere(6, 1, {1.8, 0, 0}))};
  const Detector_options options{.mode = Mode::particles};
  Detector<By_vertex_number> first(options);
  Detector<Lbg> second(options);
  add_all(first, meshes), add_all(second, meshes);
  first.detect(), second.detect();
  for (const Object_id id : {0, 1}) {
    const Bytes saved = first.save(id);
    first.load(id, saved), second.load(id, saved);
    EXPECT_EQ(second.save(id), saved);
  }
  expect_same_frame(first.detect(), second.detect());
}

std::string refusal_of(const Bytes& bytes) {
  try {
    open_saved(bytes);
  } catch (const Bad_saved_object& error) {
    return error.what();
  }
  return "none";
}

TEST(Saved_bytes, say_what_is_wrong_with_them) {
  Surface_mesh mesh = sphere(4);
  Detector<> detector;
  detector.add(mesh);
  const Bytes saved = detector.save(0);
  EXPECT_EQ(refusal_of(saved), "none");
  EXPECT_EQ(refusal_of({}), "this is no saved object");
  EXPECT_EQ(refusal_of(Bytes(100, std::byte{'x'})), "this is no saved object");
  const auto changed = [&](std::size_t at) {
    Bytes bytes = saved;
    bytes[at] ^= std::byte{1};
    return bytes;
  };
  EXPECT_EQ(refusal_of(changed(16)), "the object was saved in format 0, but this version reads format 1");
  EXPECT_EQ(refusal_of(changed(20)), "the object was saved on a machine with another byte order");
  Bytes longer = saved;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refusal_of(longer), "the saved object is broken: there are more bytes than it has");
  for (std::size_t size = 16; size < saved.size(); ++size)
    ASSERT_EQ(refusal_of({saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(size)}),
              "the saved object is broken: it ends too early");
  for (std::size_t at = 0; at < saved.size(); ++at) ASSERT_NE(refusal_of(changed(at)), "none") << at;
  EXPECT_EQ(refusal_of(changed(100)), "the saved object is broken: its bytes have changed");
}

template <class Load>
std::string broken(Load load) {
  try {
    load();
  } catch (const Bad_saved_object& error) {
    return error.what();
  }
  return "none";
}

TEST(Saved_regions, that_do_not_fit_are_refused) {
  const auto refusal = [](const Numbered_partition& regions) {
    State_writer writer;
    save_regions(regions, writer);
    const Bytes bytes = writer.take();
    State_reader reader(bytes);
    return broken([&] { load_regions(reader, 4); });
  };
  const auto partition = [](std::vector<Region_index> labels, std::vector<std::uint32_t> particles) {
    Numbered_partition regions;
    regions.labels = std::move(labels), regions.particles = std::move(particles);
    regions.regions = 2;
    return regions;
  };
  EXPECT_EQ(refusal(partition({0, 1, 1, 0}, {3, 1})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1, 0, 0}, {3, 1})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1}, {0, 1})), "none");
  EXPECT_NE(refusal(partition({0, 1, 2, 0}, {3, 1})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3, 1, 2})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {1, 3})), "none");
  EXPECT_NE(refusal(partition({0, 1, 1, 0}, {3, 4})), "none");
}

/// The lists of a tree, as they are saved.
struct Lists {
  std::vector<Tree_layout::Node> nodes;
  std::vector<std::uint32_t> face_begin{0}, vertex_begin{0}, faces, vertices;
  std::vector<Leaf_corners> corners;
};

/// Faces that share no vertices, in leaves of equal size, each of which hangs on the branch of the one before.
Lists chain(std::uint32_t leaves, std::uint32_t leaf_faces) {
  Lists lists;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto node = static_cast<std::uint32_t>(lists.nodes.size());
    if (leaf + 1 < leaves) lists.nodes.push_back({.second_child = node + 2, .leaf = leaf, .end_leaf = leaves});
    lists.nodes.push_back({.leaf = leaf, .end_leaf = leaf + 1});
    for (std::uint16_t i = 0; i < leaf_faces; ++i) {
      const auto place = static_cast<std::uint16_t>(3 * i);
      lists.faces.push_back(static_cast<std::uint32_t>(lists.faces.size()));
      lists.corners.push_back({place, static_cast<std::uint16_t>(place + 1), static_cast<std::uint16_t>(place + 2)});
    }
    lists.face_begin.push_back(static_cast<std::uint32_t>(lists.faces.size()));
    lists.vertex_begin.push_back(3 * lists.face_begin.back());
  }
  for (std::uint32_t v = 0; v < 3 * lists.faces.size(); ++v) lists.vertices.push_back(v);
  return lists;
}

std::string refusal_of(const Lists& lists) {
  std::vector<Corners> faces;
  for (const auto face : lists.faces) faces.push_back({3 * face, 3 * face + 1, 3 * face + 2});
  State_writer writer;
  writer.list(lists.nodes);
  for (const auto* list : {&lists.face_begin, &lists.vertex_begin, &lists.faces, &lists.vertices}) writer.list(*list);
  writer.list(lists.corners);
  const Bytes bytes = writer.take();
  State_reader reader(bytes);
  return broken([&] { Tree_layout::load(reader, faces, 3 * faces.size()); });
}

TEST(Saved_tree, that_is_too_deep_or_has_too_large_leaves_or_short_lists_is_refused) {
  EXPECT_EQ(refusal_of(chain(3, 128)), "none");
  EXPECT_NE(refusal_of(chain(3, 129)), "none");
  EXPECT_EQ(refusal_of(chain(4000, 1)), "none");
  EXPECT_NE(refusal_of(chain(5000, 1)), "none");
  Lists lists = chain(3, 4);
  lists.corners.pop_back();
  EXPECT_EQ(refusal_of(lists), "the saved object is broken: its tree has lists of other lengths than it needs");
}

/// What an object with particles has saved, up to its homes.
struct Saved_particles {
  struct Home {
    std::uint32_t vertex, compass;
    double angle;
  };

  std::vector<char> mode;
  std::array<std::uint64_t, 3> mesh;
  double radius;
  std::vector<std::uint32_t> joined, at;
  std::vector<Region_index> labels;
  Partition_statistics statistics;
  double effective_radius, collision_distance;
  std::uint64_t hop_limit, rings;
  std::vector<Home> homes;
  std::span<const std::byte> rest;

  explicit Saved_particles(std::span<const std::byte> bytes) {
    State_reader state(bytes);
    mode = state.list<char>();
    for (auto& number : mesh) number = state.value<std::uint64_t>();
    radius = state.value<double>();
    joined = state.list<std::uint32_t>();
    labels = state.list<Region_index>();
    statistics = state.value<Partition_statistics>();
    at = state.list<std::uint32_t>();
    effective_radius = state.value<double>();
    collision_distance = state.value<double>();
    hop_limit = state.value<std::uint64_t>();
    rings = state.value<std::uint64_t>();
    homes.resize(state.value<std::uint64_t>());
    for (auto& [vertex, compass, angle] : homes) {
      vertex = state.value<std::uint32_t>();
      compass = state.value<std::uint32_t>();
      angle = state.value<double>();
    }
    rest = bytes.subspan(written().size());
  }

  Bytes written() const {
    State_writer state;
    state.list(mode);
    for (const auto& number : mesh) state.value(number);
    state.value(radius);
    state.list(joined);
    state.list(labels);
    state.value(statistics);
    state.list(at);
    state.value(effective_radius);
    state.value(collision_distance);
    state.value(hop_limit);
    state.value(rings);
    state.value(std::uint64_t{homes.size()});
    for (const auto& [vertex, compass, angle] : homes) state.value(vertex), state.value(compass), state.value(angle);
    Bytes bytes = state.take();
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
  }
};

TEST(Saved_particles, that_do_not_fit_are_refused) {
  Surface_mesh mesh = sphere(6);
  const Detector_options options{.mode = Mode::particles, .particles = 8};
  Detector<> detector(options), victim(options);
  detector.add(mesh), victim.add(mesh);
  const Bytes saved = detector.save(0);
  const auto vertices = static_cast<std::uint32_t>(mesh.number_of_vertices());
  const auto refusal = [&](const std::function<void(Saved_particles&)>& change) {
    Saved_particles particles(open_saved(saved));
    change(particles);
    return broken([&] { victim.load(0, seal_saved(particles.written())); });
  };
  const auto join = [&](Saved_particles& p, std::uint32_t count) {
    for (std::uint32_t v = 0; v < count; ++v) p.joined.push_back(v);
  };
  const std::string start = "the saved object is broken: ";
  EXPECT_EQ(refusal([](auto&) {}), "none");
  EXPECT_EQ(refusal([&](auto& p) { join(p, vertices - 1); }), start + "it has not one place for each vertex");
  EXPECT_EQ(refusal([&](auto& p) { join(p, vertices), p.joined[3] = vertices; }),
            start + "a vertex is joined to one that does not exist");
  EXPECT_EQ(refusal([&](auto& p) { p.labels.push_back(0); }), start + "it has not one region for each vertex");
  EXPECT_EQ(refusal([&](auto& p) { p.at.clear(), p.homes.clear(); }), start + "it has no particle");
  EXPECT_EQ(refusal([&](auto& p) { p.rings = vertices + 1; }), start + "it reaches too many hops");
  EXPECT_EQ(refusal([&](auto& p) { p.hop_limit = vertices + 1; }), start + "it reaches too many hops");
  EXPECT_EQ(refusal([&](auto& p) { p.homes[3].vertex = vertices; }),
            start + "a particle has not started on the surface");
  EXPECT_EQ(refusal([&](auto& p) { p.homes[3].compass = vertices; }),
            start + "a particle has not started on the surface");
  EXPECT_EQ(refusal([&](auto& p) { std::swap(p.at[0], p.at[1]); }), start + "a particle is not in its region");
}

}  // namespace
}  // namespace lodestone
